"""Denavit-Hartenberg parameters of an arm given as lines, in both conventions, with what the lines leave free."""

import numpy as np

import circlepoint as cp

lines = [
    ([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
    ([0.0, 1.0, 0.02], [0.05, 0.0, 0.3]),
    ([0.0005, 1.0, 0.02], [0.45, 0.0, 0.32]),
]
axes = [cp.ScrewAxis(cp.JointType.revolute, cp.make_line(direction, point)) for direction, point in lines]
home = np.eye(4)
home[:3, 3] = [0.8, 0.1, 0.3]
arm = cp.ScrewChain(axes, np.zeros(3), home)

poses = np.random.default_rng(1).uniform(-3.0, 3.0, (1000, 3))
for name, convert in (("standard", cp.to_standard_dh), ("modified", cp.to_modified_dh)):
    dh = convert(arm)
    print(f"{name:10}      a mm   alpha deg        d mm   theta deg   (* free: a choice, not determined by the axes)")
    for joint, (row, free) in enumerate(zip(dh.chain.rows, dh.free, strict=True), start=1):
        values = (1e3 * row.a, np.degrees(row.alpha), 1e3 * row.d, np.degrees(row.theta))
        marks = ["*" if is_free else " " for is_free in free]
        print(f"joint {joint}  " + "".join(f"{value:11.4f}{mark}" for value, mark in zip(values, marks, strict=True)))
    for pair in dh.near_parallel:
        who = f"axes {pair.first + 1} and {pair.first + 2}"
        print(f"{who} enclose {1e3 * pair.angle:.2f} mrad: d is far away and ill conditioned")
    difference = cp.forward_kinematics(dh.chain, poses) - cp.forward_kinematics(arm, poses)
    print(f"same poses within 1e-9: {bool(np.abs(difference).max() < 1e-9)}")
