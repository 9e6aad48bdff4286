"""Closed forms of linear elasticity, and what an integrator makes of an exact oscillation or rotation.

Bodies in 2D are in plane strain: they may not change their thickness, so a free lateral face sees the modulus
E / (1 - nu^2) instead of E.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

Integrator = Literal["euler", "bdf2", "explicit"]
"""Backward Euler, the second-order backward difference, and the explicit symplectic Euler method."""

CANTILEVER_ROOTS = (1.8751040687119611, 4.694091132974174, 7.854757438237612)
"""The first solutions of cos(x) cosh(x) = -1."""

SHEAR_SHARE = 5.0 / 6.0
"""Share of a rectangular section that carries the shear force (Timoshenko)."""

_SECTIONS = 2000  # of numerical integrals over a beam


@dataclass(frozen=True)
class Solid:
    """An isotropic elastic material in 2D (plane strain) or 3D."""

    young: float  #: E [Pa]
    poisson: float  #: nu
    density: float  #: [kg/m^3]
    dimension: int = 2

    @property
    def shear(self) -> float:
        """mu [Pa]."""
        return self.young / (2.0 * (1.0 + self.poisson))

    @property
    def lame(self) -> float:
        """lambda [Pa]."""
        return self.young * self.poisson / ((1.0 + self.poisson) * (1.0 - 2.0 * self.poisson))

    @property
    def slender_modulus(self) -> float:
        """Stress over strain of a slender body whose lateral faces are free [Pa]."""
        return self.young / (1.0 - self.poisson**2) if self.dimension == 2 else self.young

    @property
    def pressure_wave_speed(self) -> float:
        """The fastest wave in the bulk [m/s]."""
        return math.sqrt((self.lame + 2.0 * self.shear) / self.density)


def bar_angular_frequency(solid: Solid, length: float, mode: int = 1) -> float:
    """Axial vibration of a bar that is fixed at one end [rad/s]: a quarter wave for mode 1."""
    return (2 * mode - 1) * math.pi / (2.0 * length) * math.sqrt(solid.slender_modulus / solid.density)


@dataclass(frozen=True)
class Beam:
    """A cantilever of rectangular section, clamped at one end; 2D: one metre deep."""

    solid: Solid
    length: float  #: from the clamp to the free end [m]
    height: float  #: in the plane of bending [m]

    @property
    def bending_stiffness(self) -> float:
        """E* I per metre of depth [N m]; I = height^3 / 12."""
        return self.solid.slender_modulus * self.height**3 / 12.0

    def self_weight_load(self, gravity: float) -> float:
        """The dimensionless load q L^3 / (E* I) of its own weight, q = density gravity height."""
        return self.solid.density * gravity * self.height * self.length**3 / self.bending_stiffness

    def shear_deflection(self, gravity: float) -> float:
        """How far the tip sinks by shear alone [m], small: integral of q (L - x) / (5/6 mu h) over the length."""
        load = self.solid.density * gravity * self.height
        return load * self.length**2 / (2.0 * SHEAR_SHARE * self.solid.shear * self.height)

    def angular_frequency(self, mode: int = 1) -> float:
        """Bending vibration of a slender beam [rad/s]."""
        mass = self.solid.density * self.height
        return (CANTILEVER_ROOTS[mode - 1] / self.length) ** 2 * math.sqrt(self.bending_stiffness / mass)

    def thick_angular_frequency(self) -> float:
        """First bending vibration of a beam that is not quite slender [rad/s].

        Softness by shear and inertia of rotation lower it by the ratio of two Rayleigh quotients, with and without
        them; each takes the static shape under the beam's own weight, so their common error cancels.
        """
        return self.angular_frequency() * math.sqrt(self._rayleigh(True) / self._rayleigh(False))

    def _rayleigh(self, thick: bool) -> float:
        """omega^2 m / (E* I) from the shape under a weight of E* I per length.

        The shape is w = x^2 (6 L^2 - 4 L x + x^2) / 24 + s (L x - x^2 / 2) with s = E* I / (5/6 mu h), and work equals
        twice the energy: omega^2 = integral of w / integral of (w^2 + h^2 / 12 psi^2), psi the turn of the sections.
        """
        x = (np.arange(_SECTIONS) + 0.5) * self.length / _SECTIONS
        shape = x**2 * (6 * self.length**2 - 4 * self.length * x + x**2) / 24.0
        turn = (self.length**3 - (self.length - x) ** 3) / 6.0
        if not thick:
            return float(shape.sum() / np.sum(shape**2))
        shape = shape + self.bending_stiffness / (SHEAR_SHARE * self.solid.shear * self.height) * (
            self.length * x - 0.5 * x**2
        )
        return float(shape.sum() / np.sum(shape**2 + self.height**2 / 12.0 * turn**2))


# What integrators do


def oscillator_root(integrator: Integrator, angular_frequency: float, dt: float) -> complex:
    """The factor z by which one step multiplies exp(i omega t) in u'' = -omega^2 u.

    As a first-order system the oscillation obeys y' = i omega y. Backward Euler: z = 1 / (1 - i omega dt). BDF2: the
    root of (3/2 - i omega dt) z^2 - 2 z + 1/2 = 0 that tends to 1 with dt. Explicit (velocity first, then place):
    z^2 - (2 - omega^2 dt^2) z + 1 = 0.
    """
    turn = angular_frequency * dt
    if integrator == "euler":
        return 1.0 / (1.0 - 1j * turn)
    if integrator == "bdf2":
        leading = 1.5 - 1j * turn
        return (2.0 + cmath.sqrt(4.0 - 2.0 * leading)) / (2.0 * leading)
    half_trace = 1.0 - 0.5 * turn**2
    return half_trace + cmath.sqrt(half_trace**2 - 1.0)


def discrete_frequency(integrator: Integrator, frequency: float, dt: float) -> float:
    """The frequency [Hz] that an exact oscillation of ``frequency`` has after the integrator with steps ``dt``."""
    root = oscillator_root(integrator, 2.0 * math.pi * frequency, dt)
    return abs(cmath.phase(root)) / (2.0 * math.pi * dt)


def discrete_decay(integrator: Integrator, frequency: float, dt: float) -> float:
    """The rate [1/s] at which the integrator damps the amplitude; the exact oscillation has 0."""
    return -math.log(abs(oscillator_root(integrator, 2.0 * math.pi * frequency, dt))) / dt


def rotation_kept(integrator: Integrator, angular_velocity: float, dt: float, steps: int) -> float:
    """The share of its angular momentum that a rigid ring keeps after ``steps`` steps of an implicit integrator.

    A point of the ring is carried to where its past motion leads it and then put back to the ring along the radius,
    which is what an infinitely stiff body does. Backward Euler: from x + v dt, and v becomes the chord over dt, so it
    also points inward. With a = omega dt the angle a step turns by goes from a to about a - a^3: in time
    d omega / dt = -omega^3 dt, a loss of 2 pi omega dt per revolution at the start.
    """
    place, velocity = 1.0 + 0.0j, 1j * angular_velocity
    way, past_velocity = 0.0j, 0.0j
    for step in range(steps):
        second_order = integrator == "bdf2" and step > 0
        free = way / 3.0 + (2.0 * dt / 9.0) * (4.0 * velocity - past_velocity) if second_order else velocity * dt
        end = place + free
        end /= abs(end)
        moved = end - place
        now = (3.0 * moved - way) / (2.0 * dt) if second_order else moved / dt
        place, way, past_velocity, velocity = end, moved, velocity, now
    return (place.conjugate() * velocity).imag / angular_velocity
