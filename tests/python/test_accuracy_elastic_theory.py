"""Truths and measures of the elastic reference cases, on motions with known answers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pbmpm.lab.accuracy.elastic import references, strain
from pbmpm.lab.accuracy.elastic.signal import fit_oscillation, measure_swing
from pbmpm.lab.accuracy.elastic.theory import (
    CANTILEVER_ROOTS,
    Beam,
    Solid,
    bar_angular_frequency,
    discrete_decay,
    discrete_frequency,
    oscillator_root,
    rotation_kept,
)

BAR = Solid(young=100.0, poisson=0.0, density=1.0)
TUREK = Solid(young=1.4e6, poisson=0.4, density=1000.0)


def test_classic_bar_swings_once_in_ten_seconds() -> None:
    assert 2 * math.pi / bar_angular_frequency(BAR, 25.0) == pytest.approx(10.0, rel=1e-12)
    assert 2 * math.pi / bar_angular_frequency(BAR, 25.0, mode=2) == pytest.approx(10.0 / 3.0, rel=1e-12)


def test_roots_of_the_cantilever() -> None:
    for root in CANTILEVER_ROOTS:
        assert math.cos(root) * math.cosh(root) == pytest.approx(-1.0, abs=1e-9)


def test_oscillating_plate_of_the_literature() -> None:
    plate = Beam(Solid(young=2e6, poisson=0.3975, density=1000.0), length=0.2, height=0.02)
    assert 2 * math.pi / plate.angular_frequency() == pytest.approx(0.254032, rel=1e-5)


def test_a_slender_beam_needs_no_correction_and_a_thick_one_is_slower() -> None:
    slender = Beam(TUREK, length=1.0, height=0.001)
    assert slender.thick_angular_frequency() == pytest.approx(slender.angular_frequency(), rel=1e-5)
    thick = Beam(TUREK, length=1.0, height=0.25)
    assert 0.90 < thick.thick_angular_frequency() / thick.angular_frequency() < 0.97


@pytest.mark.parametrize("rate, expected", [(480, 7.878), (240, 7.796), (120, 7.496), (60, 6.603)])
def test_backward_euler_slows_an_oscillation(rate: int, expected: float) -> None:
    assert discrete_frequency("euler", 7.906, 1.0 / rate) == pytest.approx(expected, abs=1e-3)
    assert discrete_frequency("euler", 7.906, 1.0 / rate) == pytest.approx(
        math.atan(2 * math.pi * 7.906 / rate) * rate / (2 * math.pi), rel=1e-12
    )


@pytest.mark.parametrize("integrator", ["euler", "bdf2", "explicit"])
def test_the_root_of_an_integrator_is_that_of_its_recursion(integrator: str) -> None:
    """Steps u'' = -u by the integrator's own formulas from its root's mode, and finds the root again."""
    dt, root = 0.3, oscillator_root(integrator, 1.0, 0.3)
    past, now = np.array([1.0, 1j]), np.array([root, 1j * root])
    if integrator == "euler":
        following = np.linalg.solve(np.array([[1.0, -dt], [dt, 1.0]]), now)
    elif integrator == "bdf2":
        following = np.linalg.solve(np.array([[1.5, -dt], [dt, 1.5]]), 2.0 * now - 0.5 * past)
    else:
        velocity = (root - 1.0) / dt - dt * root
        following = np.array([root + dt * velocity, 1j * root**2])
    assert following == pytest.approx(np.array([root**2, 1j * root**2]), abs=1e-12)


def test_damping_of_integrators() -> None:
    # |1 / (1 - i a)| = 1 / sqrt(1 + a^2)
    assert discrete_decay("euler", 1.0, 0.01) == pytest.approx(50.0 * math.log1p((0.02 * math.pi) ** 2), rel=1e-9)
    assert discrete_decay("explicit", 1.0, 0.01) == pytest.approx(0.0, abs=1e-9)
    # BDF2 damps with omega^4 dt^3 / 4.
    assert discrete_decay("bdf2", 1.0, 0.001) == pytest.approx((2 * math.pi) ** 4 * 1e-9 / 4, rel=0.01)


def test_backward_euler_brakes_a_rotation_by_its_law() -> None:
    # d omega / dt = -omega^3 dt has the solution omega0 / sqrt(1 + 2 omega0^2 dt t), to first order in omega dt.
    omega, rate = 2.0 * math.pi, 4800
    law = 1.0 / math.sqrt(1.0 + 2.0 * omega**2 / rate)
    assert rotation_kept("euler", omega, 1.0 / rate, rate) == pytest.approx(law, rel=0.1 * omega / rate)
    # BDF2 begins with one step of backward Euler, so it loses of the order of (omega dt)^2 once.
    assert 1.0 - rotation_kept("bdf2", omega, 1.0 / rate, rate) < 2.0 * (omega / rate) ** 2
    assert 1.0 - rotation_kept("bdf2", omega, 1.0 / rate, 10 * rate) < 2.0 * (omega / rate) ** 2


@pytest.mark.parametrize("frequency, decay", [(1.0, 0.0), (0.9, 0.1), (1.3, 0.9), (0.55, 2.5)])
def test_fit_finds_a_damped_oscillation(frequency: float, decay: float) -> None:
    times = np.arange(0.0, 6.0, 1.0 / 40.0)
    values = 0.3 + 2.0 * np.exp(-decay * times) * np.cos(2 * math.pi * frequency * times + 0.4)
    found = fit_oscillation(times, values, expected=1.0)
    assert found is not None
    assert found.frequency == pytest.approx(frequency, rel=1e-5)
    assert found.decay == pytest.approx(decay, abs=1e-4)
    assert found.offset == pytest.approx(0.3, abs=1e-4)
    assert found.amplitude == pytest.approx(2.0, rel=1e-3)
    assert found.residual < 1e-4


def test_fit_stands_noise_and_says_how_much_is_left() -> None:
    times = np.arange(0.0, 8.0, 0.02)
    noise = np.random.default_rng(1).normal(scale=0.1, size=len(times))
    found = fit_oscillation(times, np.sin(2 * math.pi * 1.1 * times) + noise, expected=1.0)
    assert found is not None
    assert found.frequency == pytest.approx(1.1, rel=2e-3)
    spread = np.std(np.sin(2 * math.pi * 1.1 * times) + noise)
    # The fit comes closer to the samples than the truth does, by its 5 free numbers.
    assert math.sqrt(1 - 20 / len(times)) * np.sqrt(np.mean(noise**2)) < found.residual * spread
    assert found.residual * spread <= np.sqrt(np.mean(noise**2))


def test_nothing_to_fit() -> None:
    times = np.arange(0.0, 1.0, 0.1)
    assert fit_oscillation(times, np.zeros_like(times), expected=1.0) is None
    assert fit_oscillation(times, np.full_like(times, np.nan), expected=1.0) is None
    assert fit_oscillation(times[:3], times[:3], expected=1.0) is None


def test_steady_swing_of_the_published_beam() -> None:
    across, up = map(references.turek_hron_steady, references.turek_hron_beam())
    vertical, horizontal = measure_swing(up.times, up.values), measure_swing(across.times, across.values)
    # The figures that the file's header gives are of all samples, here is every second one, 0.01 s apart: a turning
    # point is missed by up to amplitude omega^2 (0.005 s)^2 / 2.
    missed = 0.0655 * (2 * math.pi * 1.094) ** 2 * 0.005**2 / 2
    assert vertical.mean == pytest.approx(-63.959e-3, abs=missed)
    assert vertical.amplitude == pytest.approx(65.512e-3, abs=missed)
    assert horizontal.mean == pytest.approx(-14.554e-3, abs=missed)
    assert horizontal.amplitude == pytest.approx(14.555e-3, abs=missed)
    assert vertical.frequency == pytest.approx(1.0940, abs=2e-3)


def test_elastica_in_and_between_the_points() -> None:
    assert references.elastica_tip(1.0) == pytest.approx(0.123471, rel=1e-6)
    assert references.elastica_tip(10.0) == pytest.approx(0.7002, rel=1e-6)
    assert references.elastica_tip(0.01) == pytest.approx(0.00125, rel=1e-4)
    # Solved by shooting for this load: see the function below.
    assert references.elastica_tip(0.7) == pytest.approx(shoot(0.7), rel=5e-4)
    with pytest.raises(ValueError, match="outside"):
        references.elastica_tip(60.0)


def shoot(load: float) -> float:
    """Tip deflection over length of theta'' = -load (1 - s) cos theta, theta(0) = 0, theta'(1) = 0, by bisection."""
    low, high = 0.0, load
    for _ in range(60):
        theta, slope, deflection = 0.0, 0.5 * (low + high), 0.0
        for index in range(2000):
            s = (index + 0.5) / 2000
            slope -= load * (1.0 - s) * math.cos(theta + 0.5 * slope / 2000) / 2000
            deflection += math.sin(theta + 0.5 * slope / 2000) / 2000
            theta += slope / 2000
        low, high = (0.5 * (low + high), high) if slope < 0.0 else (low, 0.5 * (low + high))
    return deflection


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("model", [strain.FIXED_COROTATED, strain.NEO_HOOKEAN])
def test_stress_matches_the_uniaxial_curves(dimension: int, model: str) -> None:
    solid = Solid(young=1.0, poisson=0.3, density=1.0, dimension=dimension)
    stress, lateral = references.uniaxial_curve(dimension, 0.3, model)
    stretches = np.stack([stress.times, *[lateral.values] * (dimension - 1)], axis=1)
    found = strain.piola_stress(solid, model, stretches[:, :, None] * np.eye(dimension))
    # The table has six digits; the steepest stress changes by 30 times as much as the lateral stretch.
    assert found[:, 0, 0] == pytest.approx(stress.values, abs=3e-4)
    assert found[:, 1, 1] == pytest.approx(0.0, abs=3e-4)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("model", [strain.FIXED_COROTATED, strain.NEO_HOOKEAN])
def test_stress_is_the_derivative_of_the_energy(dimension: int, model: str) -> None:
    solid = Solid(young=3.0, poisson=0.3, density=1.0, dimension=dimension)
    shape = (dimension, dimension)
    deformation = np.eye(dimension) + 0.3 * np.random.default_rng(2).uniform(-1, 1, shape)
    stress, step = strain.piola_stress(solid, model, deformation), 1e-6
    for entry in np.ndindex(shape):
        change = np.zeros(shape)
        change[entry] = step
        rise = strain.energy_density(solid, model, deformation + change)
        rise = rise - strain.energy_density(solid, model, deformation - change)
        assert rise / (2 * step) == pytest.approx(stress[entry], abs=1e-7)


def test_rotations_have_no_stress_and_reflections_become_rotations() -> None:
    turned = np.array([[math.cos(1.0), -math.sin(1.0)], [math.sin(1.0), math.cos(1.0)]])
    for model in (strain.FIXED_COROTATED, strain.NEO_HOOKEAN):
        assert strain.piola_stress(TUREK, model, turned) == pytest.approx(0.0, abs=1e-8)
    assert np.linalg.det(strain.rotations(np.diag([1.0, -2.0]))) == pytest.approx(1.0)


def test_unknown_curves_are_named() -> None:
    with pytest.raises(ValueError, match="nu = 0.123"):
        references.uniaxial_curve(2, 0.123, "NH")


def test_angular_momentum_of_a_turning_lattice() -> None:
    """m (r^2 + dx^2 / 2) omega per particle, wherever the body is and however it drifts."""
    axis = np.arange(-3.0, 4.0)
    place = np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)
    speed = 2.0 * np.stack([-place[:, 1], place[:, 0]], axis=1)
    spin = np.broadcast_to(2.0 * np.array([[0.0, -1.0], [1.0, 0.0]]), (len(place), 2, 2))
    masses = np.full(len(place), 0.5)
    found = strain.angular_momentum(place + 5.0, speed + [3.0, 4.0], spin, masses, cell_size=2.0)
    assert found == pytest.approx(0.5 * 2.0 * np.sum(place**2 + 1.0), rel=1e-12)
    moving = strain.kinetic_energy(speed, spin, masses, cell_size=2.0)
    assert moving == pytest.approx(0.5 * 0.5 * 4.0 * np.sum(place**2 + 1.0), rel=1e-12)


def test_two_discs_start_with_the_published_energy() -> None:
    facts = references.two_discs()
    disc = math.pi * facts["R_m"] ** 2 * facts["rho"]
    speed = math.hypot(*facts["velocities"][0])
    assert disc * speed**2 == pytest.approx(facts["K0_J_per_m"], rel=1e-12)
    gap = math.dist(*facts["centres"]) - 2 * facts["R_m"]
    assert gap / (2 * speed) == pytest.approx(facts["geometric_contact_time_s"], rel=1e-12)
