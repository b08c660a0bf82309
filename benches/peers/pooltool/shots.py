"""Shots on a cloth in PolyScene and in pooltool (pip install pooltool-billiards): when balls cease to slip and rest.

Usage: shots.py POLYSCENE
Both have the same law of sliding and rolling. Impacts are compared with pooltool's simplest models, which PolyScene has too: balls
that lose nothing and do not rub (`frictionless_elastic`), and cushions that reflect a ball with its spin (`unrealistic`). Its other
cushion (Han 2005, a nose above the middle of the ball) is another law. It has no ball in the air, so no jump.
"""

import json
import math
import subprocess
import sys
import tempfile

import numpy as np
import pooltool as pt
from pooltool.events import EventType
from pooltool.physics import PhysicsEngine
from pooltool.physics.resolve import Resolver
from pooltool.physics.resolve.ball_cushion.unrealistic import UnrealisticLinear

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


# The same with a second ball, at this place from the first, or with the cushion so far ahead along x.
HITS = {
    "follow, full": ((1.5, 0.3), (-0.3 / RADIUS, 1.5 / RADIUS, 0.0), (0.4, 0.08)),
    "stun, full": ((1.5, 0.3), (0.0, 0.0, 0.0), (0.4, 0.08)),
    "draw, cut": ((1.8, 0.2), (5.0, -60.0, 0.0), (0.4, 0.03)),
    "side, cut": ((1.2, 0.1), (0.0, 30.0, 50.0), (0.5, 0.06)),
}
RAILS = {
    "rail, rolling": ((1.0, 0.4), (-0.4 / RADIUS, 1.0 / RADIUS, 0.0), 0.3),
    "rail, sliding": ((2.0, -0.7), (0.0, 0.0, 20.0), 0.3),
    "rail, side": ((1.5, -0.5), (10.0, 5.0, 60.0), 0.2),
}
CUSHION = 0.85
# Balls have next to no friction with each other, and the cloth so much more that a ball on it has what is to be (the mean of
# a pair is geometric).
SMOOTH = 1e-14


def ball_xml(number, x, y, velocity=(0.0, 0.0), spin=(0.0, 0.0, 0.0)):
    """y is up in PolyScene: (x, y, z) of pooltool is (x, z, -y)."""
    (vx, vy), (wx, wy, wz) = velocity, spin
    return f"""<SoftObject UserID="{number}"><Translation X="{x}" Y="{RADIUS}" Z="{2 * HALF - y}" /><Bounce F32="1" />
<Friction F32="{SMOOTH}" /><RollingFriction F32="{ROLLING}" /><Weight F32="{MASS}" />
<InitialVelocity X="{vx}" Y="0" Z="{-vy}" /><InitialAngularVelocity X="{wx}" Y="{wz}" Z="{-wy}" />
<Sphere><Radius F32="{RADIUS}" /></Sphere></SoftObject>"""


def polyscene(program, balls, has_rail):
    """Times at which balls begin to roll and rest, in order: of each kind, with the number of the ball."""
    cloth = f"""<HardObject UserID="1"><Translation X="{HALF}" Y="0" Z="{HALF}" /><Rotation X="{-math.pi / 2}" Y="0" Z="0" />
<Bounce F32="0.5" /><Friction F32="{SLIDING**2 / SMOOTH}" /><RollingFriction F32="{ROLLING}" />
<Plane><HalfSideX F32="{HALF}" /><HalfSideY F32="{HALF}" /></Plane></HardObject>"""
    rail = f"""<HardObject UserID="9"><Translation X="{2 * HALF}" Y="0" Z="{HALF}" /><Rotation X="0" Y="{-math.pi / 2}" Z="0" />
<Bounce F32="{CUSHION}" /><Plane><HalfSideX F32="{HALF}" /><HalfSideY F32="1" /></Plane></HardObject>"""
    scene = f"""<PolyPhysicsXml Version="1.1"><Map><Size X="100" Y="2" Z="100" /><Tiles X="4" Y="1" Z="4" /></Map>
<Simulation><Forces><GravityPlane UserID="1"><Translation X="1" Y="1" Z="1" /><Gravity X="0" Y="{-G}" Z="0" /></GravityPlane>
</Forces></Simulation><Primitives>{cloth}{rail if has_rail else ""}{"".join(balls)}</Primitives></PolyPhysicsXml>"""
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
        file.write(scene)
        file.flush()
        run = [program, "run", file.name, "--until", "60", "--events", "-"]
        lines = subprocess.run(run, capture_output=True, text=True, check=True).stdout.splitlines()
    events = [json.loads(line) for line in lines if line.startswith("{")]
    # What lies from the start says so at once.
    told = [event for event in events if event["kind"] in ("roll", "rest") and event["t"] > 0.0]
    return [(event["kind"], event["b"], event["t"]) for event in told]


def pooltool(balls, states):
    """The same from pooltool's own events."""
    table = pt.Table.from_table_specs(pt.objects.PocketTableSpecs(l=2 * HALF, w=2 * HALF))
    for ball, (velocity, spin) in zip(balls.values(), states):
        ball.state.rvw[1] = np.array([*velocity, 0.0])
        ball.state.rvw[2] = np.array(spin)
        ball.state.s = pt.constants.sliding if any(velocity) else pt.constants.stationary
    system = pt.System(table=table, balls=balls, cue=pt.Cue(cue_ball_id="2"))
    resolver = Resolver.default()
    resolver.ball_linear_cushion = UnrealisticLinear()
    pt.simulate(system, engine=PhysicsEngine(resolver=resolver), inplace=True)
    told = []
    for event in system.events:
        if event.event_type == EventType.SLIDING_ROLLING:
            told.append(("roll", event.ids[0], event.time))
        elif event.event_type in (EventType.ROLLING_SPINNING, EventType.ROLLING_STATIONARY):
            told.append(("rest", event.ids[0], event.time))
    return [event for event in told if event[2] > 0.0]


def pool_ball(number, x, y):
    return pt.Ball.create(number, xy=(x, y), R=RADIUS, m=MASS, u_s=SLIDING, u_r=ROLLING, g=G, e_c=CUSHION)


def shots():
    """Name, balls of either program, start of each ball, whether there is a cushion."""
    for name, (velocity, spin) in SHOTS.items():
        yield name, [(HALF, HALF, velocity, spin)], False
    still = ((0.0, 0.0), (0.0, 0.0, 0.0))
    for name, (velocity, spin, (dx, dy)) in HITS.items():
        yield name, [(HALF, HALF, velocity, spin), (HALF + dx, HALF + dy, *still)], False
    for name, (velocity, spin, ahead) in RAILS.items():
        # In the middle of the cushion there is a pocket.
        yield name, [(2 * HALF - ahead, 1.5 * HALF, velocity, spin)], True


def main():
    program, worst = sys.argv[1], 0.0
    print(f"pooltool {pt.__version__}; times in s\n| shot | rolls | rests | times compared | off, relative |")
    print("| --- | --- | --- | --- | --- |")
    for name, balls, has_rail in shots():
        numbers = [str(number) for number in range(2, 2 + len(balls))]
        ours = polyscene(program, [ball_xml(n, *ball) for n, ball in zip(numbers, balls)], has_rail)
        theirs = pooltool({n: pool_ball(n, *ball[:2]) for n, ball in zip(numbers, balls)}, [b[2:] for b in balls])
        # In order for each ball: two balls may do something at one time.
        ours, theirs = sorted(ours, key=lambda e: (e[1], e[2])), sorted(theirs, key=lambda e: (e[1], e[2]))
        if [event[:2] for event in ours] != [event[:2] for event in theirs]:
            print(f"| {name} | differs: {ours} and {theirs} |")
            worst = math.inf
            continue
        off = max(abs(one[2] / other[2] - 1.0) for one, other in zip(ours, theirs))
        worst = max(worst, off)
        first, last = ours[0][2], max(event[2] for event in ours)
        print(f"| {name} | {first:.12g} | {last:.12g} | {len(ours)} | {off:.1e} |")
    print(f"largest difference {worst:.1e}")
    return worst > 1e-9


if __name__ == "__main__":
    sys.exit(main())
