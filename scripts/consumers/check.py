"""Loads exported scenes into the programs they are for and compares masses, places and motion with the scene file.

Usage: check.py CONSUMER PROGRAM WORK SCENE...   with CONSUMER mujoco, usd, gltf or sdf.
Exit code 0: all agree; 1: something does not; 3: the consumer is not here.
"""

import csv
import json
import math
import pathlib
import struct
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

# Of places and directions, m; relative, of masses.
TOLERANCE = 1e-6
# After a second of flight, m.
FLIGHT_TOLERANCE = 1e-3
SKIPPED = 3
HERE = pathlib.Path(__file__).resolve().parent

failures = []


def fail(text):
    failures.append(text)
    print(f"  wrong: {text}")


def number(text):
    return float(text.replace(",", "."))


def vector(element):
    return [0.0] * 3 if element is None else [number(element.get(axis)) for axis in "XYZ"]


class Body:
    """A body as the scene file has it, read without the program."""

    def __init__(self, element):
        self.dynamic = element.tag == "SoftObject"
        self.position = vector(element.find("Translation"))
        self.matrix = rotation(*vector(element.find("Rotation")))
        weight, bounce = element.find("Weight"), element.find("Bounce")
        self.mass = 1.0 if weight is None else number(weight.get("F32"))
        self.bounce = 1.0 if bounce is None else number(bounce.get("F32"))
        self.velocity = vector(element.find("InitialVelocity"))
        radius = element.find("Sphere/Radius")
        self.radius = None if radius is None else number(radius.get("F32"))


def bodies(scene):
    root = ElementTree.parse(scene).getroot()
    return [Body(element) for element in root.find("Primitives") or []]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def rotation(alpha, beta, gamma):
    """Rx(alpha) Ry(beta) Rz(gamma), rows of columns."""
    (sa, ca), (sb, cb), (sc, cc) = [(math.sin(a), math.cos(a)) for a in (alpha, beta, gamma)]
    about_x = [[1, 0, 0], [0, ca, -sa], [0, sa, ca]]
    about_y = [[cb, 0, sb], [0, 1, 0], [-sb, 0, cb]]
    about_z = [[cc, -sc, 0], [sc, cc, 0], [0, 0, 1]]
    return product(product(about_x, about_y), about_z)


def of_quaternion(w, x, y, z):
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]


def z_up(v):
    return [v[0], -v[2], v[1]]


def z_up_matrix(m):
    return [m[0], [-c for c in m[2]], m[1]]


def far(a, b, tolerance=TOLERANCE):
    scale = max([1.0] + [abs(value) for value in b])
    return len(a) != len(b) or any(not abs(p - q) <= tolerance * scale for p, q in zip(a, b))


def far_matrix(a, b):
    return any(far(p, q) for p, q in zip(a, b))


def export(program, scene, to, path, *options):
    command = [program, "export", str(scene), "--to", to, "--force", "-o", str(path), *options]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        fail(f"{scene}: export to {to}: {done.stderr}")
    return done.returncode == 0


# Scenes whose motion is looked at too, and how much of it.
MOVING = {"bounce", "cradle", "drag", "bin", "billiards", "bowling"}
MOTION = ["--until", "1.05", "--fps", "10"]


def motion(program, scene):
    """How the moving bodies are at the frames, y up: label to a list of (time, place, orientation as a matrix or None)."""
    command = [program, "export", str(scene), "--to", "csv", *MOTION]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    tracks = {}
    for row in csv.DictReader(lines):
        place = [float(row[axis]) for axis in ("x_m", "y_m", "z_m")]
        turn = of_quaternion(*(float(row[part]) for part in ("qw", "qx", "qy", "qz"))) if row["qw"] else None
        tracks.setdefault(row["label"], []).append((float(row["t_s"]), place, turn))
    return tracks


def last_state(program, scene, until):
    """Positions of the moving bodies at the end of a run, y up, in file order."""
    command = [program, "run", str(scene), "--until", str(until), "--states", "-"]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    rows = [json.loads(line) for line in lines]
    end = max(row["t"] for row in rows)
    return {body["id"]: body["x"] for row in rows if row["t"] == end for body in row["bodies"]}


# ---------------------------------------------------------------- MuJoCo


def check_mujoco(program, work, scenes):
    import mujoco

    for scene in scenes:
        path = work / f"{scene.stem}.mjcf.xml"
        if not export(program, scene, "mjcf", path):
            continue
        model = mujoco.MjModel.from_xml_path(str(path))
        data = mujoco.MjData(model)
        expected = bodies(scene)
        if model.nbody != len(expected) + 1:
            fail(f"{scene}: {model.nbody - 1} bodies instead of {len(expected)}")
            continue
        if model.nkey:
            mujoco.mj_resetDataKeyframe(model, data, 0)
        for body, at in zip(expected, range(1, model.nbody)):
            if far(model.body_pos[at], z_up(body.position)):
                fail(f"{scene}: body {at} is at {model.body_pos[at]}")
            if far_matrix(of_quaternion(*model.body_quat[at]), z_up_matrix(body.matrix)):
                fail(f"{scene}: body {at} is turned by {model.body_quat[at]}")
            if body.dynamic:
                if not abs(model.body_mass[at] / body.mass - 1) <= TOLERANCE:
                    fail(f"{scene}: body {at} has {model.body_mass[at]} kg")
                joint = model.body_jntadr[at]
                speed = data.qvel[model.jnt_dofadr[joint] :][:3]
                place = data.qpos[model.jnt_qposadr[joint] :][:3]
                if far(speed, z_up(body.velocity)) or far(place, z_up(body.position)):
                    fail(f"{scene}: body {at} starts with {speed} at {place}")
    foreign(mujoco, program, work)
    for name in ["hard/throw.xml", "drag.xml"]:
        flight(mujoco, program, work, next(s for s in scenes if str(s).endswith("/" + name)))
    for one, other in [(1, 1), (1, 0.8), (0.9, 0.5), (0.5, 0.4)]:
        bounce(mujoco, program, work, one, other)
    for one, other in [(0.02, 0.02), (0.01, 0.04), (0.05, 0), (0, 0)]:
        rolling(mujoco, program, work, one, other)


def started(mujoco, path):
    """A model with its state at the start."""
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


def foreign(mujoco, program, work):
    """A file of MuJoCo's own kind: what the program reads is what MuJoCo makes of it, the scene moved as a whole."""
    source, path = HERE.parents[1] / "scenes/foreign/balls.mjcf.xml", work / "foreign.xml"
    command = [program, "import", str(source), "--force", "-o", str(path)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        return fail(f"{source}: import: {done.stderr}")
    model, data = started(mujoco, source)
    mujoco.mj_forward(model, data)
    is_ball = lambda geom: model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_SPHERE and model.geom_contype[geom]
    geoms = [geom for geom in range(model.ngeom) if is_ball(geom)]
    balls = [body for body in bodies(path) if body.radius is not None]
    if len(geoms) != len(balls):
        fail(f"{source}: {len(balls)} balls instead of {len(geoms)}")
    shift = [a - b for a, b in zip(z_up(balls[0].position), data.geom_xpos[geoms[0]])]
    for geom, ball in zip(geoms, balls):
        place = [a + b for a, b in zip(data.geom_xpos[geom], shift)]
        body = model.geom_bodyid[geom]
        if far(place, z_up(ball.position)) or abs(model.geom_size[geom][0] - ball.radius) > TOLERANCE:
            fail(f"{source}: a ball is at {ball.position}, of {ball.radius} m")
        if ball.dynamic:
            speed = data.qvel[model.jnt_dofadr[model.body_jntadr[body]] :][:3]
            if far(speed, z_up(ball.velocity)) or abs(model.body_mass[body] / ball.mass - 1) > TOLERANCE:
                fail(f"{source}: a ball has {ball.velocity} m/s and {ball.mass} kg")


def flight(mujoco, program, work, scene):
    """A second without impacts."""
    model, data = started(mujoco, work / f"{scene.stem}.mjcf.xml")
    steps = round(1.0 / model.opt.timestep)
    for _ in range(steps):
        mujoco.mj_step(model, data)
    expected = last_state(program, scene, steps * model.opt.timestep)
    moving = [at for at in range(1, model.nbody) if model.body_jntnum[at]]
    for at, (label, place) in zip(moving, expected.items()):
        error = math.dist(data.xpos[at], z_up(place))
        print(f"  {scene.name}, body {label}: {error:.1e} m apart after a second")
        if not error <= FLIGHT_TOLERANCE:
            fail(f"{scene}: body {label} is {error} m away after a second")


BOUNCE = """<PolyPhysicsXml Version="1.0"><Map><Size X="4" Y="4" Z="4" /><Tiles X="4" Y="4" Z="4" /></Map>
<Simulation><Forces><GravityPlane UserID="1"><Translation X="0" Y="0" Z="0" /><Gravity X="0" Y="-9.8" Z="0" />
</GravityPlane></Forces></Simulation><Primitives><HardObject UserID="1"><Translation X="2" Y="0" Z="2" />
<Rotation X="-1.5707963267948966" Y="0" Z="0" /><Bounce F32="{}" /><Plane><HalfSideX F32="2" /><HalfSideY F32="2" />
</Plane></HardObject><SoftObject UserID="2"><Translation X="2" Y="2.1" Z="2" /><Bounce F32="{}" />
<Sphere><Radius F32="0.1" /></Sphere></SoftObject></Primitives></PolyPhysicsXml>
"""

# Of the restitution that comes out, over some thirty steps.
BOUNCE_TOLERANCE = 0.01


def bounce(mujoco, program, work, one, other):
    """A fall of two metres on a plate: the speed after over the speed before."""
    scene, path = work / "one-bounce.xml", work / "one-bounce.mjcf.xml"
    scene.write_text(BOUNCE.format(one, other))
    if not export(program, scene, "mjcf", path):
        return
    model, data = started(mujoco, path)
    fastest, highest = 0.0, 0.0
    while data.time < 1.2 and (data.qvel[2] <= 0 or data.ncon > 0):
        mujoco.mj_step(model, data)
        fastest = min(fastest, data.qvel[2])
    highest = data.qvel[2]
    restitution = highest / -fastest
    print(f"  bounce {one} on {other}: e = {restitution:.3f} instead of {one * other:.3f}")
    if not abs(restitution - one * other) <= BOUNCE_TOLERANCE:
        fail(f"restitution {restitution} instead of {one * other}")


ROLLING = """<PolyPhysicsXml Version="1.1"><Map><Size X="4" Y="4" Z="4" /><Tiles X="4" Y="4" Z="4" /></Map>
<Simulation><Forces><GravityPlane UserID="1"><Translation X="0" Y="0" Z="0" /><Gravity X="0" Y="-9.8" Z="0" />
</GravityPlane></Forces></Simulation><Primitives><HardObject UserID="1"><Translation X="2" Y="0" Z="2" />
<Rotation X="-1.5707963267948966" Y="0" Z="0" /><Bounce F32="0" /><Friction F32="0.5" /><RollingFriction F32="{}" />
<Plane><HalfSideX F32="2" /><HalfSideY F32="2" /></Plane></HardObject><SoftObject UserID="2">
<Translation X="1" Y="0.1" Z="2" /><Bounce F32="0.5" /><Friction F32="0.5" /><RollingFriction F32="{}" />
<InitialAngularVelocity X="0" Y="0" Z="-10" /><InitialVelocity X="1" Y="0" Z="0" />
<Sphere><Radius F32="0.1" /></Sphere></SoftObject></Primitives></PolyPhysicsXml>
"""

# Of the share of the load that slows a ball; its contact gives way.
ROLLING_TOLERANCE = 0.02


def rolling(mujoco, program, work, one, other):
    """A ball that rolls for a second: what it loses of its speed is its coefficient times g."""
    scene, path = work / "one-roll.xml", work / "one-roll.mjcf.xml"
    scene.write_text(ROLLING.format(one, other))
    if not export(program, scene, "mjcf", path):
        return
    model, data = started(mujoco, path)
    while data.time < 1.0:
        mujoco.mj_step(model, data)
    expected = math.sqrt(one * other)
    found = (1 - data.qvel[0]) / 9.8 / data.time
    print(f"  rolling friction {one} on {other}: {found:.4f} instead of {expected:.4f}")
    if not abs(found - expected) <= ROLLING_TOLERANCE * expected + 1e-4:
        fail(f"rolling friction {found} instead of {expected}")


# ---------------------------------------------------------------- USD


def check_usd(program, work, scenes):
    from pxr import Usd, UsdGeom, UsdPhysics

    for scene in scenes:
        path = work / f"{scene.stem}.usda"
        if not export(program, scene, "usd", path):
            continue
        stage = Usd.Stage.Open(str(path))
        if UsdGeom.GetStageUpAxis(stage) != "Y" or UsdGeom.GetStageMetersPerUnit(stage) != 1:
            fail(f"{scene}: axes or units")
        prims = list(stage.GetPrimAtPath("/World/Bodies").GetChildren())
        expected = bodies(scene)
        if len(prims) != len(expected):
            fail(f"{scene}: {len(prims)} bodies instead of {len(expected)}")
        for prim, body in zip(prims, expected):
            world = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(Usd.TimeCode.Default())
            rows = [[world[j][i] for j in range(3)] for i in range(3)]
            if far(list(world.ExtractTranslation()), body.position) or far_matrix(rows, body.matrix):
                fail(f"{scene}: {prim.GetPath()} is at {world}")
            if not prim.HasAPI(UsdPhysics.CollisionAPI):
                fail(f"{scene}: {prim.GetPath()} does not collide")
            if prim.HasAPI(UsdPhysics.RigidBodyAPI) != body.dynamic:
                fail(f"{scene}: {prim.GetPath()} moves or does not, against the scene")
            if body.dynamic:
                mass = UsdPhysics.MassAPI(prim).GetMassAttr().Get()
                speed = UsdPhysics.RigidBodyAPI(prim).GetVelocityAttr().Get()
                if not abs(mass / body.mass - 1) <= TOLERANCE or far(list(speed), body.velocity):
                    fail(f"{scene}: {prim.GetPath()} has {mass} kg and {speed} m/s")
            if body.radius is not None:
                if UsdGeom.Sphere(prim).GetRadiusAttr().Get() != body.radius:
                    fail(f"{scene}: {prim.GetPath()} has another radius")
            materials = prim.GetRelationship("material:binding:physics").GetTargets()
            material = UsdPhysics.MaterialAPI(stage.GetPrimAtPath(materials[0]))
            if abs(material.GetRestitutionAttr().Get() - min(body.bounce, 1)) > TOLERANCE:
                fail(f"{scene}: {prim.GetPath()} has another restitution")
        if scene.stem in MOVING:
            usd_motion(program, work, scene)


def usd_motion(program, work, scene):
    from pxr import Usd, UsdGeom, UsdPhysics

    path = work / f"{scene.stem}-motion.usda"
    if not export(program, scene, "usd", path, *MOTION):
        return
    stage = Usd.Stage.Open(str(path))
    tracks = motion(program, scene)
    moving = [prim for prim in stage.Traverse() if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    if len(moving) != len(tracks):
        fail(f"{scene}: {len(moving)} bodies move instead of {len(tracks)}")
    for prim in moving:
        track = tracks[prim.GetCustomDataByKey("UserID")]
        for time, place, turn in track:
            code = Usd.TimeCode(time * stage.GetTimeCodesPerSecond())
            world = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(code)
            if far(list(world.ExtractTranslation()), place):
                fail(f"{scene}: {prim.GetPath()} is elsewhere at {time} s")
            # Rows of its matrices are columns here.
            turned = world.ExtractRotationMatrix().GetTranspose()
            if turn and far_matrix([list(turned.GetRow(at)) for at in range(3)], turn):
                fail(f"{scene}: {prim.GetPath()} is turned otherwise at {time} s")
        if not UsdPhysics.RigidBodyAPI(prim).GetKinematicEnabledAttr().Get():
            fail(f"{scene}: {prim.GetPath()} would be moved by an engine")


# ---------------------------------------------------------------- glTF


def check_gltf(program, work, scenes):
    """Masses and places from the JSON; gltf-validator, whose module is in WORK/node_modules, looks at the rest."""
    if not (work / "node_modules/gltf-validator").is_dir():
        raise ImportError("gltf-validator")
    files = []
    for scene in scenes:
        path = work / f"{scene.stem}.glb"
        if not export(program, scene, "gltf", path):
            continue
        files.append(path.name)
        data = path.read_bytes()
        length = int.from_bytes(data[12:16], "little")
        nodes = json.loads(data[20 : 20 + length]).get("nodes", [])
        expected = bodies(scene)
        if len([node for node in nodes if "camera" not in node]) != len(expected):
            fail(f"{scene}: {len(nodes)} nodes")
        for node, body in zip(nodes, expected):
            x, y, z, w = node["rotation"]
            if far(node["translation"], body.position) or far_matrix(of_quaternion(w, x, y, z), body.matrix):
                fail(f"{scene}: {node['name']} is elsewhere")
            if body.dynamic and node["extras"]["mass_kg"] != body.mass:
                fail(f"{scene}: {node['name']} has another mass")
        if scene.stem in MOVING:
            moving = work / f"{scene.stem}-motion.glb"
            if export(program, scene, "gltf", moving, *MOTION):
                files.append(moving.name)
                gltf_motion(program, scene, moving.read_bytes())
    script = """
      const fs = require('fs'), validator = require('gltf-validator');
      (async () => {
        for (const file of process.argv.slice(1)) {
          const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
          const { numErrors, numWarnings, messages } = report.issues;
          if (numErrors + numWarnings > 0) console.log(file, JSON.stringify(messages.slice(0, 3)));
        }
      })();
    """
    done = subprocess.run(["node", "-e", script, *files], cwd=work, capture_output=True, text=True)
    if done.returncode != 0 or done.stdout:
        fail(f"gltf-validator: {done.stdout}{done.stderr}")


def gltf_motion(program, scene, data):
    """The animation's keys against places and orientations at the frames, to the digits of a 32-bit number."""
    length = int.from_bytes(data[12:16], "little")
    root, buffer = json.loads(data[20 : 20 + length]), data[20 + length + 8 :]

    def floats(accessor, width):
        accessor = root["accessors"][accessor]
        start = root["bufferViews"][accessor["bufferView"]]["byteOffset"]
        values = struct.unpack_from(f"<{width * accessor['count']}f", buffer, start)
        return [values[at : at + width] for at in range(0, len(values), width)]

    (animation,) = root["animations"]
    tracks = motion(program, scene)
    expected = sum(2 if track[0][2] else 1 for track in tracks.values())
    if len(animation["channels"]) != expected:
        fail(f"{scene}: {len(animation['channels'])} channels instead of {expected}")
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        node = root["nodes"][channel["target"]["node"]]
        track = tracks[str(node["extras"]["UserID"])]
        turns = channel["target"]["path"] == "rotation"
        times, values = floats(sampler["input"], 1), floats(sampler["output"], 4 if turns else 3)
        keys = [key for (key,) in times]
        for time, place, turn in track:
            nearest = min(range(len(keys)), key=lambda at: abs(keys[at] - time))
            value = list(values[nearest])
            is_off = far_matrix(of_quaternion(value[3], *value[:3]), turn) if turns else far(value, place)
            if abs(keys[nearest] - time) > 1e-6 or is_off:
                fail(f"{scene}: {node['name']} is elsewhere at {time} s")


# ---------------------------------------------------------------- SDF


# libsdformat compares all names with all others: minutes for more.
MOST_MODELS = 2000


def check_sdf(program, work, scenes):
    """What libsdformat reads, by the program WORK/read_sdf."""
    reader = work / "read_sdf"
    if not reader.is_file():
        raise ImportError("libsdformat")
    for scene in scenes:
        path, expected = work / f"{scene.stem}.sdf", bodies(scene)
        if not export(program, scene, "sdf", path):
            continue
        if len(expected) > MOST_MODELS:
            print(f"  {scene.name}: skipped, {len(expected)} models are too many for libsdformat")
            continue
        done = subprocess.run([reader, path], capture_output=True, text=True)
        if done.returncode != 0 or done.stderr:
            fail(f"{scene}: {done.stderr}")
            continue
        models = [line.split("\t")[1:] for line in done.stdout.splitlines() if line.startswith("model")]
        if len(models) != len(expected):
            fail(f"{scene}: {len(models)} models instead of {len(expected)}")
        for (name, static, place, turned, mass, shape), body in zip(models, expected):
            matrix = of_quaternion(*[float(word) for word in turned.split()])
            if far([float(word) for word in place.split()], z_up(body.position)):
                fail(f"{scene}: {name} is at {place}")
            if far_matrix(matrix, z_up_matrix(body.matrix)):
                fail(f"{scene}: {name} is turned by {turned}")
            if body.dynamic == bool(int(static)):
                fail(f"{scene}: {name} moves or does not, against the scene")
            if body.dynamic and not abs(float(mass) / body.mass - 1) <= TOLERANCE:
                fail(f"{scene}: {name} has {mass} kg")


CHECKS = {"mujoco": check_mujoco, "usd": check_usd, "gltf": check_gltf, "sdf": check_sdf}


def main():
    consumer, program, work, *scenes = sys.argv[1:]
    try:
        CHECKS[consumer](program, pathlib.Path(work), [pathlib.Path(scene) for scene in scenes])
    except ImportError as missing:
        print(f"  not here: {missing}")
        sys.exit(SKIPPED)
    sys.exit(1 if failures else 0)


main()
