"""Pictures of a gait with matplotlib."""
from __future__ import annotations


def plot(gait, path=None, joints=("hip", "knee", "ankle")):
    """Two rows of plots against % of the cycle: angles in degrees above, torques in N m/kg below; vertical forces at the right."""
    import matplotlib
    if path is not None:
        matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np

    stride = gait.stride(201)
    events = gait.solve.result.gait_events
    mass = events.body_weight_n / (gait.solve.spec.gravity_m_s2 or 9.81)
    columns = len(joints) + 1
    figure, axes = plt.subplots(2, columns, figsize=(3.4 * columns, 5.4), sharex=True, squeeze=False,
                                layout="constrained")
    sides = (("r", "right", "#c8553d"), ("l", "left", "#1b6ca8"))
    for place, joint in enumerate(joints):
        for letter, side, color in sides:
            name = f"{joint}_{letter}"
            axes[0][place].plot(stride["percent"], np.degrees(stride[name]), color=color, label=side)
            axes[1][place].plot(stride["percent"], stride[name + ".effort"] / mass, color=color)
        axes[0][place].set_title(joint)
        axes[1][place].set_xlabel("% of the gait cycle")
    for letter, side, color in sides:
        axes[0][-1].plot(stride["percent"], 100 * stride[side + ".force_z"] / events.body_weight_n, color=color)
        axes[1][-1].plot(stride["percent"], 100 * stride[side + ".force_x"] / events.body_weight_n, color=color)
    axes[0][-1].set_title("forces of the ground")
    axes[0][0].set_ylabel("angle, °")
    axes[1][0].set_ylabel("torque, N m/kg")
    axes[0][-1].set_ylabel("normal, % of body weight")
    axes[1][-1].set_ylabel("along the ground, %")
    axes[1][-1].set_xlabel("% of the gait cycle")
    axes[0][0].legend(frameon=False)
    for axis in axes.flat:
        axis.spines[["top", "right"]].set_visible(False)
        axis.set_xlim(0, 100)
    figure.suptitle(f"{gait.solve.spec.model.name}, {np.degrees(gait.slope_rad):.3g}°, {gait.speed_m_s:.3g} m/s: "
                    f"{gait.verdict}")
    if path is not None:
        figure.savefig(path)
    return figure
