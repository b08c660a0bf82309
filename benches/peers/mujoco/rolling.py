"""Balls that slide and roll, in MuJoCo (pip install mujoco): how far they are from the closed form.

Usage: rolling.py POLYSCENE FOLDER
FOLDER holds the scenes that `scripts/peers.sh --case friction --write FOLDER` wrote, each with one ball without spin on a plate
that falls along x. PolyScene exports them as MJCF, with contacts stiff enough for any restitution; here nothing bounces, and
contacts and step are MuJoCo's defaults (solref 0.02 1, 2 ms), besides other steps.
"""

import math
import pathlib
import subprocess
import sys
import tempfile

import mujoco
import numpy as np

UNTIL, G, FRICTION = 3.0, 9.81, 0.3
STEPS = (1 / 60, 1 / 240, 0.002, 0.00025)
CONES = {"pyramid": mujoco.mjtCone.mjCONE_PYRAMIDAL, "ellipse": mujoco.mjtCone.mjCONE_ELLIPTIC}


def closed_form(speed, angle, t):
    """Way and speed downhill: slides until s/(7/2 mu a_n - a_t), then rolls with 5/7 a_t."""
    load, along = G * math.cos(angle), G * math.sin(angle)
    ends = speed / (3.5 * FRICTION * load - along)
    sliding = along - FRICTION * load if speed else along
    slid, rolled = min(t, ends), max(t - ends, 0.0)
    then = speed + slid * sliding
    way = slid * (speed + 0.5 * slid * sliding) + rolled * (then + 0.5 * rolled * 5 / 7 * along)
    return way, then + rolled * 5 / 7 * along, ends


def measure(path, step, cone):
    """Largest distance from the closed form, difference of the velocity at the end, when it begins to roll and should."""
    model = mujoco.MjModel.from_xml_path(str(path))
    model.opt.timestep, model.opt.cone = step, cone
    for solref, solimp in ((model.geom_solref, model.geom_solimp), (model.pair_solref, model.pair_solimp)):
        solref[:], solimp[:] = (0.02, 1.0), (0.9, 0.95, 0.001, 0.5, 2.0)
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    start, velocity = data.qpos[:3].copy(), data.qvel[:3].copy()
    # Gravity, whatever axis is up, and the plate's normal: both from the model.
    normal = data.geom_xmat[plate(model)].reshape(3, 3)[:, 2].copy()
    gravity = model.opt.gravity.copy()
    normal *= -np.sign(normal @ gravity)
    along = gravity - (gravity @ normal) * normal
    angle = math.atan2(np.linalg.norm(along), -gravity @ normal)
    speed = float(np.linalg.norm(velocity))
    downhill = velocity / speed if speed else along / np.linalg.norm(along)
    radius = model.geom_size[ball(model)][0]
    worst, rolls = 0.0, math.nan
    while data.time < UNTIL - 0.5 * step:
        mujoco.mj_step(model, data)
        way, expected, ends = closed_form(speed, angle, data.time)
        worst = max(worst, float(np.linalg.norm(data.qpos[:3] - start - way * downhill)))
        turning = data.xmat[model.geom_bodyid[ball(model)]].reshape(3, 3) @ data.qvel[3:6]
        slip = data.qvel[:3] - np.cross(turning, radius * normal)
        if math.isnan(rolls) and np.linalg.norm(slip - (slip @ normal) * normal) <= 0.01 * speed:
            rolls = data.time
    off = float(np.linalg.norm(data.qvel[:3] - expected * downhill))
    return worst, off, rolls, ends


def ball(model):
    return int(np.flatnonzero(model.geom_type == mujoco.mjtGeom.mjGEOM_SPHERE)[0])


def plate(model):
    return int(np.flatnonzero(model.geom_type != mujoco.mjtGeom.mjGEOM_SPHERE)[0])


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    print(f"\nMuJoCo {mujoco.__version__}; a ball rolls when 1 % of its slip is left")
    print("scene                          steps/s  cone     position m    final v   rolls at s  instead of")
    with tempfile.TemporaryDirectory() as work:
        for scene in sorted(folder.glob("friction*.xml")):
            model = pathlib.Path(work) / f"{scene.stem}.mjcf.xml"
            export = [program, "export", scene, "--to", "mjcf", "--output", model]
            subprocess.run(export, check=True, capture_output=True)
            for step in STEPS:
                for name, cone in CONES.items():
                    worst, off, rolls, ends = measure(model, step, cone)
                    steps = f"{1 / step:.0f}"
                    print(f"{scene.stem:<30} {steps:>7}  {name}  {worst:>10.1e} {off:>10.1e}   {rolls:>10.4f}  {ends:>10.4f}")


if __name__ == "__main__":
    main()
