"""Shots on a cloth in PolyScene and in pooltool (pip install pooltool-billiards): when balls cease to slip and rest.

Usage: shots.py POLYSCENE
Both have the same law of sliding and rolling, so times agree to rounding. Their impacts differ: pooltool's cushions and
ball-ball models are others, so that only what is before the first impact is compared.
"""

import json
import math
import subprocess
import sys
import tempfile

import numpy as np
import pooltool as pt
from pooltool.events import EventType

RADIUS, MASS, G = 0.028575, 0.170097, 9.81
SLIDING, ROLLING = 0.2, 0.01
HALF = 50.0

# Velocity (m/s) and spin (rad/s); x and y on the table, z up, as pooltool has them. None runs along a cushion: pooltool
# divides by the rate at which a ball comes nearer to it.
SHOTS = {
    "stun": ((1.0, 0.1), (0.0, 0.0, 0.0)),
    "follow": ((1.0, 0.3), (0.0, 60.0, 0.0)),
    "draw": ((1.2, 0.1), (0.0, -50.0, 0.0)),
    "long draw": ((0.4, 0.1), (0.0, -80.0, 0.0)),
    "side spin": ((1.0, -0.2), (0.0, 0.0, 70.0)),
    "masse": ((0.8, 0.1), (-40.0, 10.0, 30.0)),
    "spin on the spot": ((0.01, 0.02), (30.0, 0.0, 0.0)),
    "oblique": ((-0.7, 0.9), (25.0, -35.0, 5.0)),
    "hard": ((2.5, 0.5), (0.0, 0.0, 0.0)),
    "soft": ((0.05, 0.02), (1.0, -2.0, 0.0)),
}


def polyscene(program, velocity, spin):
    """Times of roll and rest. y is up here: (x, y, z) of pooltool is (x, -z, y)."""
    (vx, vy), (wx, wy, wz) = velocity, spin
    cloth = f"""<HardObject UserID="1"><Translation X="{HALF}" Y="0" Z="{HALF}" /><Rotation X="{-math.pi / 2}" Y="0" Z="0" />
<Bounce F32="0.5" /><Friction F32="{SLIDING}" /><RollingFriction F32="{ROLLING}" />
<Plane><HalfSideX F32="{HALF}" /><HalfSideY F32="{HALF}" /></Plane></HardObject>"""
    ball = f"""<SoftObject UserID="2"><Translation X="{HALF}" Y="{RADIUS}" Z="{HALF}" /><Bounce F32="0.5" />
<Friction F32="{SLIDING}" /><RollingFriction F32="{ROLLING}" /><Weight F32="{MASS}" />
<InitialVelocity X="{vx}" Y="0" Z="{-vy}" /><InitialAngularVelocity X="{wx}" Y="{wz}" Z="{-wy}" />
<Sphere><Radius F32="{RADIUS}" /></Sphere></SoftObject>"""
    scene = f"""<PolyPhysicsXml Version="1.1"><Map><Size X="100" Y="2" Z="100" /><Tiles X="4" Y="1" Z="4" /></Map>
<Simulation><Forces><GravityPlane UserID="1"><Translation X="1" Y="1" Z="1" /><Gravity X="0" Y="{-G}" Z="0" /></GravityPlane>
</Forces></Simulation><Primitives>{cloth}{ball}</Primitives></PolyPhysicsXml>"""
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
        file.write(scene)
        file.flush()
        run = [program, "run", file.name, "--until", "60", "--events", "-"]
        lines = subprocess.run(run, capture_output=True, text=True, check=True).stdout.splitlines()
    events = [json.loads(line) for line in lines if line.startswith("{")]
    times = {event["kind"]: event["t"] for event in events}
    return times.get("roll"), times.get("rest")


def pooltool(velocity, spin):
    """The same from pooltool's own events."""
    table = pt.Table.from_table_specs(pt.objects.PocketTableSpecs(l=2 * HALF, w=2 * HALF))
    ball = pt.Ball.create("cue", xy=(HALF, HALF), R=RADIUS, m=MASS, u_s=SLIDING, u_r=ROLLING, g=G)
    ball.state.rvw[1] = np.array([*velocity, 0.0])
    ball.state.rvw[2] = np.array(spin)
    ball.state.s = pt.constants.sliding
    system = pt.System(table=table, balls={"cue": ball}, cue=pt.Cue(cue_ball_id="cue"))
    pt.simulate(system, inplace=True)
    first = {}
    for event in system.events:
        first.setdefault(event.event_type, event.time)
    spinning = first.get(EventType.ROLLING_SPINNING, first.get(EventType.ROLLING_STATIONARY))
    return first.get(EventType.SLIDING_ROLLING), spinning


def main():
    program, worst = sys.argv[1], 0.0
    print(f"pooltool {pt.__version__}; times in s\n| shot | rolls | off, relative | rests | off, relative |")
    print("| --- | --- | --- | --- | --- |")
    for name, (velocity, spin) in SHOTS.items():
        ours, theirs = polyscene(program, velocity, spin), pooltool(velocity, spin)
        offs = [abs(one / other - 1.0) for one, other in zip(ours, theirs)]
        worst = max(worst, *offs)
        print(f"| {name} | {ours[0]:.12g} | {offs[0]:.1e} | {ours[1]:.12g} | {offs[1]:.1e} |")
    print(f"largest difference {worst:.1e}")
    return worst > 1e-9


if __name__ == "__main__":
    sys.exit(main())
