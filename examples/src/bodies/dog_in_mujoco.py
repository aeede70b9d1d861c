"""A robot dog in MuJoCo whose motors are led from outside, in lockstep.

Reads a line of JSON that says what there is and how it stands; then, again and again, writes what the dog feels as a line of
JSON and reads the torques of its motors as another, until there are no more.
"""

import json
import sys

try:
    import mujoco
    import numpy as np
except ImportError:
    sys.exit(3)


def main():
    job = json.loads(sys.stdin.readline())
    friction, height = job["friction"], job["height"]
    # Its priority makes the friction of the ground that of the pair.
    ground = f'<geom type="plane" size="1000 1000 1" friction="{friction}" priority="1"/></worldbody>'
    model = mujoco.MjModel.from_xml_string(job["mjcf"].replace("</worldbody>", ground, 1))
    model.opt.timestep = job["step"] / job["substeps"]
    model.opt.gravity[:] = [0.0, 0.0, -job["gravity"]]
    data = mujoco.MjData(model)
    places = [model.joint(name).qposadr[0] for name in job["joints"]]
    rates = [model.joint(name).dofadr[0] for name in job["joints"]]
    motors = [model.actuator(name).id for name in job["joints"]]
    balls = [
        next(
            geom
            for geom in range(model.ngeom)
            if model.geom_bodyid[geom] == model.body(shank).id
            and model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_SPHERE
        )
        for shank in job["shanks"]
    ]
    trunk = model.body(job["trunk"]).id
    data.qpos[:7] = [0.0, 0.0, height, 1.0, 0.0, 0.0, 0.0]
    data.qpos[places] = job["angles"]
    mujoco.mj_forward(model, data)
    loads = np.zeros(len(balls))
    while True:
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, data.qpos[3:7])
        # MuJoCo tells the spin of a free body in its own frame.
        spin = turn.reshape(3, 3) @ data.qvel[3:6]
        # After a step places are those of before it.
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        felt = [data.qpos[:7], data.qvel[:3], spin, data.subtree_com[trunk], data.qpos[places], data.qvel[rates], loads]
        print(json.dumps(np.concatenate(felt).tolist()), flush=True)
        line = sys.stdin.readline()
        if not line.strip():
            return
        data.ctrl[motors] = json.loads(line)
        loads = np.zeros(len(balls))
        for _ in range(job["substeps"]):
            mujoco.mj_step(model, data)
            loads += forces(model, data, balls) / job["substeps"]


def forces(model, data, balls):
    """How hard the ground presses each of these geoms, N."""
    pressed, force = np.zeros(len(balls)), np.zeros(6)
    for index in range(data.ncon):
        contact = data.contact[index]
        # A foot that meets another leg does not stand; the world is body 0.
        if 0 not in (model.geom_bodyid[contact.geom1], model.geom_bodyid[contact.geom2]):
            continue
        for place, ball in enumerate(balls):
            if ball in (contact.geom1, contact.geom2):
                mujoco.mj_contactForce(model, data, index, force)
                pressed[place] += abs(force[0])
    return pressed


main()
