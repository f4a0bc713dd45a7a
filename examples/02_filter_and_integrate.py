"""From acceleration to displacement: a zero-phase filter removes vibration, integrating makes much of a bias."""

import numpy as np

import circlepoint as cp

rate, span, frequency = 500.0, 0.4, 0.5
t = np.arange(2001) / rate
true = span * (1.0 - np.cos(2 * np.pi * frequency * t)) / 2
acceleration = span / 2 * (2 * np.pi * frequency) ** 2 * np.cos(2 * np.pi * frequency * t)
vibration = 0.1 * np.sin(2 * np.pi * 35.0 * t)
low_pass = cp.butter(4, 10.0, rate)


def displacement(reading: np.ndarray) -> np.ndarray:
    """Integrate twice from rest, m from m/s^2."""
    velocity = cp.cumulative_trapezoid(cp.sosfiltfilt(low_pass, reading), dx=1.0 / rate, initial=0.0)
    return cp.cumulative_trapezoid(velocity, dx=1.0 / rate, initial=0.0)


print("bias mm/s^2   vibration left mm/s^2   displacement error after 2 s, 4 s, mm")
for bias in (0.0, 0.005):
    reading = acceleration + vibration + bias
    left = cp.sosfiltfilt(low_pass, reading) - cp.sosfiltfilt(low_pass, acceleration) - bias
    error = displacement(reading) - true
    largest = np.abs(left[500:1500]).max()
    print(f"{1e3 * bias:11.1f}   {1e3 * largest:21.3f}   {1e3 * error[1000]:10.2f} {1e3 * error[2000]:10.2f}")
