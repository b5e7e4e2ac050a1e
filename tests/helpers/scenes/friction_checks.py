"""What friction is held to: checks against closed forms, and against the conforming reference."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from harness.models.interface import ContactSettings, InterfaceType
from harness.models.parts import Param
from harness.post.compare import Measure
from harness.run.runner import Runner, RunResult
from scenes import block_on_incline
from studies.closed_forms import incline
from studies.friction.stick_points import displaced
from studies.models import partial_slip, plate_on_layer, sheared_blocks
from studies.models.sheared_blocks import Kind
from studies.pages.gallery.friction import plate_curve
from studies.post import slip_zones

Array = NDArray[np.float64]
INCLINE_BAR = 1e-4
PLATE_BAR, DRAINED_BAR = 0.01, 1e-3
"""Of mu_eff/mu_eq after the first ten steps, and at the end."""
STICK_BAR, AUGMENTED_BAR = 1e-3, 1e-8
"""Of the displacement, over the shear, with default settings and augmented to 1e-9."""
PARTIAL_SLIP_BAR = 0.02
MESHES = (8, 16)
"""Elements over half the width of the contact."""


def block_pushed_up(runner: Runner, *, block_is_primary: bool = True) -> list[Measure]:
    """The block on an incline: force over weight in each step in which it slides, but the one in which it starts."""
    name = f"block-on-incline-{'block' if block_is_primary else 'slope'}-primary"
    run = runner(block_on_incline.BlockOnIncline(block_is_primary=block_is_primary, name=name).model())
    base, nodes = run.model.mesh.node_sets["base"] - 1, run.nodes
    along, weight = (np.abs(nodes[column][:, base].sum(axis=1)) for column in ("Rx", "Rz"))
    slides = nodes.times > block_on_incline.STANDING + 1.5
    exact = incline.force_over_weight(block_on_incline.SLOPE, block_on_incline.FRICTION)
    worst = float(np.abs(along[slides] / weight[slides] - exact).max())
    return [Measure(f"Block on an incline, F/G less {exact:.6f}", worst, INCLINE_BAR)]


def plate_sliding(runner: Runner, solid_fraction: float, *, layer_is_primary: bool = True) -> list[Measure]:
    """The plate on a layer: the effective friction coefficient over time, and when the layer has drained."""
    name = f"plate-on-layer-phi-{solid_fraction:g}-{'layer' if layer_is_primary else 'plate'}-primary"
    model = plate_on_layer.PlateOnLayer(solid_fraction, layer_is_primary=layer_is_primary, name=name).model()
    _, found, exact = plate_curve(runner(model), solid_fraction)
    after = slice(plate_on_layer.EVEN_STEPS, None)
    error = np.abs(found - exact)[after]
    relative = float((error / exact[after])[exact[after] > 0.1].max())
    note = f"relative to mu_eff where that is above a tenth of mu_eq: {relative:.2g}"
    return [
        Measure(f"Plate on a layer, phi = {solid_fraction:g}, mu_eff/mu_eq", float(error.max()), PLATE_BAR, note=note),
        Measure(f"Plate on a layer, phi = {solid_fraction:g}, drained", float(abs(found[-1] - 1.0)), DRAINED_BAR),
    ]


def sheared_pair(
    runner: Runner, kind: Kind, settings: ContactSettings | None = None, newton: float = 1e-9
) -> tuple[RunResult, RunResult]:
    """The sheared block split, and its conforming reference."""
    name = f"sheared-{kind.value}{'-augmented' if settings else ''}"
    split = sheared_blocks.ShearedBlocks(kind, settings=settings, newton=newton, name=name)
    reference = replace(split, interface=InterfaceType.CONFORMING, settings=None, name=f"{name}-conforming")
    return runner(split.model()), runner(reference.model())


def stick(runner: Runner, kind: Kind) -> list[Measure]:
    """The sheared block with default settings: displacements against those of the conforming reference."""
    split, reference = sheared_pair(runner, kind)
    note = f"{split.report.iterations} iterations, conforming: {reference.report.iterations}"
    return [
        Measure(
            f"Stick, {kind.value}, against the conforming reference", displaced(split, reference), STICK_BAR, note=note
        )
    ]


def augmented_stick(runner: Runner, kind: Kind) -> list[Measure]:
    """The same with the augmented Lagrangian to 1e-9, and Newton's iterations to a hundredth of that: FEBio's energies
    are to fall by the square, and with 1e-12 that is below rounding.
    """
    extra = (Param("fric_coeff", sheared_blocks.FRICTION),)
    settings = ContactSettings(laugon="AUGLAG", tolerance=1e-9, maxaug=50, extra=extra)
    split, reference = sheared_pair(runner, kind, settings, newton=1e-11)
    note = f"{split.report.augmentations} augmentations"
    return [Measure(f"Stick, {kind.value}, AUGLAG", displaced(split, reference), AUGMENTED_BAR, note=note)]


def partial_slips(runner: Runner) -> list[Measure]:
    """A cylinder in partial slip on two meshes: Hertz's contact, stick zone and peak shear, and that their errors fall.

    The peak pressure's is as small on both meshes.
    """
    runs = [runner(partial_slip.PartialSlip(n, name=f"partial-slip-{n}").model()) for n in MESHES]
    pressed = [measure for run in runs for measure in slip_zones.zones(run).pressed(PARTIAL_SLIP_BAR)]
    coarse, fine = (slip_zones.zones(run).measures(PARTIAL_SLIP_BAR) for run in runs)
    falls = [
        Measure(f"{b.name}, fine over coarse mesh", b.value / a.value, 1.0) for a, b in zip(coarse, fine, strict=True)
    ]
    named = [
        replace(m, name=f"{m.name}, {n} elements") for n, ms in zip(MESHES, (coarse, fine), strict=True) for m in ms
    ]
    return [*pressed, *named, *falls]
