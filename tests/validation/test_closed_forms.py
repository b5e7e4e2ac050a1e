"""The closed forms satisfy the equations they claim to solve; no run is needed."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import toeplitz
from scipy.special import erfc

from harness.closed_forms import (
    composite_slab,
    confined_compression,
    penalty_leak,
    steady_convection,
    transient_diffusion,
    two_layer_convection,
)
from harness.models import convection, diffusion
from studies.closed_forms import biphasic_layers, cattaneo_mindlin, hertz, incline, sliding_plate

SLAB = {"height": 2.0, "diffusivity": 5e-4}
FIRST = composite_slab.Layer(1.0, diffusivity=5e-4, porosity=0.8, solubility=1.0)
SECOND = composite_slab.Layer(0.7, diffusivity=1.3e-3, porosity=0.6, solubility=0.4)
CONDUCTANCES = [4e-4, np.inf]


def test_transient_diffusion_obeys_its_equation():
    z, t, dz, dt = np.linspace(-0.9, 0.9, 19), 900.0, 1e-3, 1e-2
    c = lambda z, t: transient_diffusion.concentration(z, t, **SLAB)  # noqa: E731
    rate = (c(z, t + dt) - c(z, t - dt)) / (2 * dt)
    curvature = (c(z + dz, t) - 2 * c(z, t) + c(z - dz, t)) / dz**2
    np.testing.assert_allclose(rate, SLAB["diffusivity"] * curvature, rtol=1e-5, atol=1e-10)


def test_transient_diffusion_at_its_boundaries_and_limits():
    assert transient_diffusion.concentration(-1.0, 700.0, ambient=2.0, **SLAB) == pytest.approx(2.0, abs=1e-14)
    inside, face = transient_diffusion.concentration([1.0 - 1e-5, 1.0], 700.0, **SLAB)
    assert inside - face == pytest.approx(0.0, abs=1e-9)
    assert transient_diffusion.concentration(1.0, 1e6, **SLAB) == pytest.approx(1.0, abs=1e-12)


def test_transient_diffusion_starts_like_a_half_space():
    depth, t = np.linspace(0.0, 0.5, 11), 2.0
    expected = erfc(depth / (2 * np.sqrt(SLAB["diffusivity"] * t)))
    np.testing.assert_allclose(transient_diffusion.concentration(depth - 1.0, t, **SLAB), expected, atol=1e-12)


@pytest.mark.parametrize(("z", "t"), [(0.0, 0.0), (0.0, -1.0), (1.1, 1.0)])
def test_transient_diffusion_refuses_what_it_cannot_answer(z, t):
    with pytest.raises(ValueError, match=r"must"):
        transient_diffusion.concentration(z, t, **SLAB)


@pytest.mark.parametrize("peclet", [-30.0, -1.0, 0.0, 1e-8, 1.0, 10.0, 2000.0])
def test_steady_convection_between_its_faces(peclet):
    ends = steady_convection.concentration([-1.0, 1.0], height=2.0, peclet=peclet, upstream=0.9, downstream=0.2)
    np.testing.assert_allclose(ends, [0.9, 0.2], rtol=1e-13)


@pytest.mark.parametrize("peclet", [-3.0, 1e-8, 1.0, 10.0])
def test_steady_convection_has_one_flux(peclet):
    z, dz = np.linspace(-0.95, 0.95, 39), 1e-4
    c = lambda z: steady_convection.concentration(z, height=2.0, peclet=peclet)  # noqa: E731
    flux = peclet / 2.0 * c(z) - (c(z + dz) - c(z - dz)) / (2 * dz)
    np.testing.assert_allclose(flux, flux[0], rtol=1e-6)


def test_peclet_numbers_of_the_paper():
    """Pe = h w0/(d phi_w) with w0 = k (p_u - p_d)/h."""
    for expected, drop in convection.PRESSURES.items():
        found = convection.PERMEABILITY * drop / (diffusion.DIFFUSIVITY * convection.POROSITY)
        assert found == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("conductance", CONDUCTANCES)
def test_composite_slab_obeys_its_equations(conductance):
    t, s = 400.0, 1e-4
    c = lambda z: composite_slab.concentration(np.asarray(z), t, FIRST, SECOND, conductance)  # noqa: E731
    below, above = c([1.0 - s, 1.0]), c([1.0 + 1e-12, 1.0 + s])
    j1 = -FIRST.capacity * FIRST.diffusivity * (below[1] - below[0]) / s
    j2 = -SECOND.capacity * SECOND.diffusivity * (above[1] - above[0]) / s
    assert j1 == pytest.approx(j2, rel=1e-3)
    assert below[1] - above[0] == pytest.approx(j1 / conductance, rel=1e-3, abs=1e-9)
    assert c([0.0])[0] == pytest.approx(1.0, abs=1e-13)


@pytest.mark.parametrize("conductance", CONDUCTANCES)
def test_composite_slab_starts_empty_and_ends_full(conductance):
    z = np.linspace(0.05, 1.7, 34)
    early = composite_slab.concentration(z, 0.02, FIRST, SECOND, conductance)
    late = composite_slab.concentration(z, 1e6, FIRST, SECOND, conductance)
    np.testing.assert_allclose(early, 0.0, atol=1e-9)
    np.testing.assert_allclose(late, 1.0, atol=1e-12)


@pytest.mark.parametrize("cut", [0.3, 1.0, 1.5])
def test_composite_slab_of_one_material_is_a_slab(cut):
    z = np.linspace(0.0, 2.0, 41)
    first = composite_slab.Layer(cut, diffusivity=5e-4, porosity=0.8, solubility=0.7)
    second = composite_slab.Layer(2.0 - cut, diffusivity=5e-4, porosity=0.8, solubility=0.7)
    expected = transient_diffusion.concentration(z - 1.0, 300.0, **SLAB)
    np.testing.assert_allclose(composite_slab.concentration(z, 300.0, first, second), expected, atol=1e-12)


def test_composite_slab_finds_every_root_where_poles_coincide():
    """With L1/sqrt(d1) = 1 and L2/sqrt(d2) = 2 each pole of tan a is one of cot b."""
    first = composite_slab.Layer(1.0, diffusivity=1.0, porosity=1.0, solubility=1.0)
    second = composite_slab.Layer(2.0, diffusivity=1.0, porosity=1.0, solubility=1.0)
    z = np.linspace(0.0, 3.0, 31)
    expected = transient_diffusion.concentration(z - 1.5, 0.1, height=3.0, diffusivity=1.0)
    np.testing.assert_allclose(composite_slab.concentration(z, 0.1, first, second), expected, atol=1e-12)


@pytest.mark.parametrize("conductance", CONDUCTANCES)
@pytest.mark.parametrize("flux", [-3e-4, 0.0, 4e-4])
def test_two_layer_convection_between_its_faces_and_over_the_interface(conductance, flux):
    first = two_layer_convection.Layer(1.0, 5e-4, 5e-4, porosity=0.8, solubility=1.0)
    second = two_layer_convection.Layer(0.7, 3e-4, 9e-4, porosity=0.6, solubility=0.4)
    given = two_layer_convection.Conditions(flux, 0.9, 0.2, conductance)
    j = two_layer_convection.solute_flux(first, second, given)
    ends = two_layer_convection.concentration([0.0, 1.0, 1.0 + 1e-12, 1.7], first, second, given)
    np.testing.assert_allclose(ends[[0, 3]], [0.9, 0.2], rtol=1e-9)
    assert ends[1] - ends[2] == pytest.approx(j / conductance, rel=1e-6, abs=1e-9)


def test_leak_is_that_of_layers_without_convection():
    first = two_layer_convection.Layer(1.0, 5e-4, 5e-4, porosity=0.8, solubility=1.0)
    given = two_layer_convection.Conditions(0.0, 1.0, 0.0, 4e-4)
    jump = two_layer_convection.solute_flux(first, first, given) / given.conductance
    resistance = first.thickness / first.conductance
    assert penalty_leak.relative_jump((resistance, resistance), 4e-4) == pytest.approx(jump, rel=1e-13)
    assert jump == pytest.approx(1.0 / 3.0, rel=1e-13)


def test_confined_compression_is_consistent():
    data = {"load": 1e-3, "modulus": 2.0, "height": 1.5}
    zeta, tau, s = np.linspace(0.1, 0.9, 9), 0.2, 1e-4
    u = lambda zeta, tau: confined_compression.displacement(zeta, tau, **data)  # noqa: E731
    curvature = (u(zeta + s, tau) - 2 * u(zeta, tau) + u(zeta - s, tau)) / s**2
    rate = (u(zeta, tau + s) - u(zeta, tau - s)) / (2 * s)
    np.testing.assert_allclose(rate, curvature, rtol=1e-4, atol=1e-12)
    strain = (u(zeta + s, tau) - u(zeta - s, tau)) / (2 * s) / data["height"]
    pressure = confined_compression.fluid_pressure(zeta, tau, load=data["load"])
    np.testing.assert_allclose(pressure, data["load"] - data["modulus"] * strain, rtol=1e-6, atol=1e-12)


def test_confined_compression_at_its_limits():
    data = {"load": 1e-3, "modulus": 2.0, "height": 1.5}
    final = data["load"] / data["modulus"] * data["height"]
    assert confined_compression.displacement(1.0, 50.0, **data) == pytest.approx(final, rel=1e-13)
    early = confined_compression.displacement(1.0, 1e-4, **data)
    assert early == pytest.approx(final * 2 * np.sqrt(1e-4 / np.pi), rel=1e-3)


def half_ellipse(x, half_width):
    return np.sqrt(np.maximum(0.0, 1.0 - (x / half_width) ** 2))


def shear(x, half_width, ratio, bound):
    """Of a cylinder in partial slip, by the half-width of the zone that sticks."""
    stuck = cattaneo_mindlin.stick_half_width(half_width, ratio)
    held = stuck / half_width * half_ellipse(x, stuck) if stuck else 0.0
    return bound * (half_ellipse(x, half_width) - held)


def test_hertz_pressure_carries_the_force():
    modulus = 0.7
    a = hertz.half_width(0.1, 3.0, modulus)
    x = a * np.sin(np.linspace(-np.pi / 2, np.pi / 2, 2001))
    carried = np.trapezoid(hertz.peak_pressure(0.1, 3.0, modulus) * half_ellipse(x, a), x)
    assert carried == pytest.approx(0.1, rel=1e-5)


@pytest.mark.parametrize(("slope", "friction"), [(0.1, 0.3), (0.0, 0.3), (0.5, 0.0), (-0.1, 0.3)])
def test_block_on_an_incline_is_in_balance(slope, friction):
    angle = np.arctan(slope)
    force = incline.force_over_weight(slope, friction)
    normal = np.cos(angle) + force * np.sin(angle)
    along, upward = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    total = np.array([force, -1.0]) + normal * (upward - friction * along)
    np.testing.assert_allclose(total, 0.0, atol=1e-15)


def test_block_on_an_incline_as_published():
    assert incline.force_over_weight(0.1, 0.3) == pytest.approx(0.412371, abs=5e-7)
    with pytest.raises(ValueError, match="stuck"):
        incline.force_over_weight(2.0, 0.5)


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.75, 1.0])
def test_partial_slip_carries_the_tangential_force_within_the_bound(ratio):
    a, bound = 0.2, 0.3
    x = a * np.sin(np.linspace(-np.pi / 2, np.pi / 2, 20001))
    q = shear(x, a, ratio, bound)
    assert np.trapezoid(q, x) == pytest.approx(ratio * np.pi * a * bound / 2.0, rel=1e-5, abs=1e-12)
    assert np.all(q <= bound * np.sqrt(1.0 - (x / a) ** 2) + 1e-15)
    assert q.max() == pytest.approx(cattaneo_mindlin.peak_shear(ratio, bound), rel=1e-3, abs=1e-12)


def test_hertz_pressure_is_fitted_by_its_own_half_width_and_peak():
    a, peak = 2.0, 3.0
    x = np.linspace(-0.9, 0.7, 7) * a
    fitted = hertz.half_ellipse_through(x, peak * np.sqrt(1.0 - (x / a) ** 2))
    np.testing.assert_allclose(fitted, (a, peak), rtol=1e-12)


def test_partial_slip_leaves_the_stick_zone_undeformed():
    """The surface strain of a shear q is proportional to the principal value of INT q(s)/(x - s) ds, here by modes:
    with x = a cos(t), q = a sum of sin(n t), that integral is -pi times the sum of cos(n t).
    """
    a, ratio = 1.0, 0.51
    c = cattaneo_mindlin.stick_half_width(a, ratio)
    points = 4000
    s = a * np.cos(np.pi * (np.arange(points) + 0.5) / points)
    q = shear(s, a, ratio, 1.0)
    x = np.linspace(-0.8, 0.8, 9) * c
    modes = np.arange(1, 801)
    weights = 2.0 / points * q @ np.sin(np.outer(np.arccos(s / a), modes))
    strain = np.cos(np.outer(np.arccos(x / a), modes)) @ weights
    np.testing.assert_allclose(strain, 0.0, atol=2e-3)
    outside = np.cos(modes * np.arccos(0.9 * a)) @ weights
    assert abs(outside) > 0.1


def test_partial_slip_refuses_more_than_slides():
    with pytest.raises(ValueError, match="from 0 to 1"):
        cattaneo_mindlin.stick_half_width(1.0, 1.1)


def test_friction_under_a_plate_follows_the_drainage():
    """An independent solution of p_tau = p_zz, drained at z = 0, impermeable at z = 1: Crank-Nicolson after Euler."""
    n, steps, end = 100, 400, 0.4
    dt, h = end / steps, 1.0 / n
    laplace = (np.diag(np.full(n, -2.0)) + np.diag(np.ones(n - 1), 1) + np.diag(np.ones(n - 1), -1)) / h**2
    laplace[-1, -2] *= 2.0
    p = np.ones(n)
    for step in range(steps):
        implicit = 1.0 if step < 4 else 0.5
        p = np.linalg.solve(np.eye(n) - implicit * dt * laplace, p + (1.0 - implicit) * dt * laplace @ p)
    assert sliding_plate.load_support(end) == pytest.approx(p[-1], abs=1e-4)
    assert sliding_plate.relative_friction(end, 0.1) == pytest.approx(1.0 - 0.9 * p[-1], abs=1e-4)


@pytest.mark.parametrize("phi", [0.0, 0.1, 0.5, 1.0])
def test_friction_under_a_plate_at_its_limits(phi):
    early, late = sliding_plate.relative_friction([1e-3, 10.0], phi)
    assert early == pytest.approx(phi, abs=1e-12)
    assert late == pytest.approx(1.0, abs=1e-9)


def test_hertz_sphere_carries_the_force_and_has_no_gap():
    """The displacement below the middle of the pressure, (1/(pi E*)) INT p/s dA, is the approach."""
    force, radius, modulus = 0.1, 3.0, 0.7
    a, p0 = hertz.sphere_radius(force, radius, modulus), hertz.sphere_peak_pressure(force, radius, modulus)
    angle = np.linspace(0.0, np.pi / 2, 2001)
    r, p = a * np.sin(angle), p0 * np.cos(angle)
    assert np.trapezoid(p * 2.0 * np.pi * r, r) == pytest.approx(force, rel=1e-5)
    sunk = np.trapezoid(p * 2.0, r) / modulus
    assert sunk == pytest.approx(a**2 / radius, rel=1e-5)


LAYERS = (biphasic_layers.Layer(1.0, 0.5, 1e-3), biphasic_layers.Layer(0.7, 0.8, 4e-3))
SHAPES = list(biphasic_layers.Shape)


def layers_over_time(shape, steps=4000):
    """A ramp and then a constant force: contact, times, force, half-width."""
    contact = biphasic_layers.Contact(LAYERS, 40.0, shape)
    times = np.linspace(0.0, 1.5 / contact.rate, steps + 1)
    force = 2e-3 * np.minimum(1.0, times / times[steps // 4])
    return contact, times, force, contact.half_width(biphasic_layers.accumulated_load(times, force, contact.rate))


@pytest.mark.parametrize("shape", SHAPES)
def test_equal_biphasic_layers_have_the_rate_of_one(shape):
    h, mu, k = 1.0, 0.5, 1e-3
    contact = biphasic_layers.Contact((LAYERS[0], LAYERS[0]), 40.0, shape)
    assert contact.rate == pytest.approx(3.0 * mu * k / h**2, rel=1e-14)
    assert contact.compliance == pytest.approx(2.0 * h**3 / (3.0 * mu), rel=1e-14)


@pytest.mark.parametrize("shape", SHAPES)
def test_biphasic_layers_have_no_gap_and_no_slope_at_the_edge(shape):
    """-m lap P = delta - r^2/(2R) inside, P = 0 and grad P = 0 at the edge."""
    contact, a, s = biphasic_layers.Contact(LAYERS, 40.0, shape), 9.0, 1e-2
    r = np.linspace(0.5, 8.5, 17)
    p = lambda r: contact.accumulated_pressure(r, a)  # noqa: E731
    laplacian = (p(r + s) - 2.0 * p(r) + p(r - s)) / s**2
    if shape is biphasic_layers.Shape.SPHERE:
        laplacian = laplacian + (p(r + s) - p(r - s)) / (2.0 * s * r)
    gap = contact.approach(a) - r**2 / (2.0 * contact.radius)
    np.testing.assert_allclose(-contact.compliance * laplacian, gap, atol=1e-4 * gap.max())
    assert p(a) == 0.0
    assert p(a - s) < 5.0 * (s / a) ** 2 * p(0.0)


@pytest.mark.parametrize("shape", SHAPES)
def test_biphasic_layers_obey_the_equation_of_their_half_width(shape):
    """The rate: n a^(n-1) a' = factor m R (F' + chi F)."""
    contact, times, force, a = layers_over_time(shape)
    middle, n = slice(100, -1), shape.power
    rate = np.gradient(a, times)
    loaded = shape.load * contact.compliance * contact.radius * (np.gradient(force, times) + contact.rate * force)
    off = np.abs(n * a ** (n - 1) * rate / loaded - 1.0)[middle]
    assert np.median(off) < 1e-6
    assert np.sum(off > 1e-3) <= 3, "where the ramp ends"


@pytest.mark.parametrize("shape", SHAPES)
def test_the_pressure_of_biphasic_layers_carries_the_force(shape):
    contact, times, force, a = layers_over_time(shape, steps=1000)
    r = np.linspace(0.0, float(a[-1]), 301)
    p = np.array([biphasic_layers.pressure(x, times, force, contact) for x in r])
    weight = 2.0 * np.pi * r if shape is biphasic_layers.Shape.SPHERE else 2.0 * np.ones_like(r)
    for step in (250, 600, 1000):
        assert np.trapezoid(p[:, step] * weight, r) == pytest.approx(force[step], rel=2e-3)


@pytest.mark.parametrize(("shape", "factor"), list(zip(SHAPES, (15.0 / 16.0, 3.0 / np.pi), strict=True)))
def test_biphasic_layers_at_first_and_under_a_constant_load(shape, factor):
    contact, force = biphasic_layers.Contact(LAYERS, 40.0, shape), 3e-3
    a = contact.half_width(force)
    assert contact.load(float(a)) == pytest.approx(force, rel=1e-13)
    area = a if shape is biphasic_layers.Shape.LINE else a**2
    assert contact.accumulated_pressure(0.0, a) == pytest.approx(factor * force / area, rel=1e-13)
    times = np.linspace(0.0, 2.0 / contact.rate, 5)
    load = biphasic_layers.accumulated_load(times, np.full(5, force), contact.rate)
    np.testing.assert_allclose(contact.half_width(load), a * (1.0 + contact.rate * times) ** (1.0 / shape.power))


def elastic_layer_edge(half_width: int, per_thickness: int) -> float:
    """Distance of the edge of contact from that of thin layers, in thicknesses, for an incompressible elastic layer.

    The surface compliance of a layer that is fixed below and free of shear above is, over 2 mu s/h,
    (sinh 2s - 2s)/(cosh 2s + 1 + 2 s^2), with s the wave number times h. The pressure has hats for shape functions
    and leaves no gap at nodes.
    """
    n, step, points = half_width * per_thickness, 1.0 / per_thickness, 1 << 13
    s = 2.0 * np.pi * np.abs(np.fft.fftfreq(points, step))[1:]
    low = np.minimum(s, 30.0)
    compliance = np.zeros(points)
    compliance[1:] = (np.sinh(2 * low) - 2 * low) / (np.cosh(2 * low) + 1 + 2 * low**2) / (2.0 * s)
    compliance[1:] *= np.sinc(s * step / (2.0 * np.pi)) ** 2
    influence = np.fft.ifft(compliance).real
    x = step * np.arange(-n, n + 1)
    system = np.column_stack([toeplitz(influence[: 2 * n + 1])[:-1, 1:-1], -np.ones(2 * n)])
    pressure = np.linalg.solve(system, -(x[:-1] ** 2) / 2.0)[:-1]
    layer = biphasic_layers.Contact((biphasic_layers.Layer(1.0, 1.0, 0.0),), 1.0)
    return float(layer.half_width(pressure.sum() * step)) - half_width


def test_the_edge_of_thin_layers_is_that_of_the_integral_equation():
    assert elastic_layer_edge(32, 8) == pytest.approx(biphasic_layers.EDGE, abs=0.02)
