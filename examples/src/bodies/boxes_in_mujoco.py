"""A step of boxes of a metre that fall into piles of ten, in MuJoCo with its own settings: prints ms of processor time."""

import sys
import time

try:
    import mujoco
except ImportError:
    sys.exit(3)

STEP = 1.0 / 60.0


def boxes(count):
    bodies = "".join(
        f'<body pos="{i // 10 % 10 * 3.0} {i // 100 * 3.0} {0.6 + i % 10 * 1.05}">'
        '<freejoint/><geom type="box" size="0.5 0.5 0.5" density="500"/></body>'
        for i in range(count)
    )
    ground = '<geom type="plane" size="1000 1000 1"/>'
    return (
        f'<mujoco><option timestep="{STEP}" gravity="0 0 -9.81"/><default><geom friction="0.5"/></default>'
        f"<worldbody>{ground}{bodies}</worldbody></mujoco>"
    )


def main():
    count, steps = int(sys.argv[1]), int(sys.argv[2])
    model = mujoco.MjModel.from_xml_string(boxes(count))
    data = mujoco.MjData(model)
    before = time.process_time()
    for _ in range(steps):
        mujoco.mj_step(model, data)
    print((time.process_time() - before) / steps * 1e3)


main()
