"""Rules on ties: what would not be tied, and what is held twice."""

import math
from collections.abc import Iterator

import numpy as np

from harness.arrays import Array
from harness.preflight import rays
from harness.preflight.contact_types import ANY_DISTANCE, STICKY, TIED
from harness.preflight.finding import Finding, error, note, short, warning
from harness.preflight.model import METHODS
from harness.preflight.rules import cohesive, settings, surfaces
from harness.preflight.rules.motion import held_axes
from harness.preflight.sides import DEFAULT_RADIUS, Joint, sample

ITERATIVE = (*settings.ITERATIVE_SOLVERS, "cg", "hypre_pcg_amg")
AHEAD = 0.25  # how far ahead a facet of tied-mixture looks by default, in its longest edge


def joined_facets(joint: Joint) -> Iterator[Finding]:
    """Surfaces that have facets in common."""
    one, two = ({tuple(sorted(set(row))) for row in side.surface.corners.tolist()} for side in joint.sides)
    if one & two:
        seen = (
            f"surfaces '{joint.contact.pair.primary.name}' and '{joint.contact.pair.secondary.name}' have "
            f"{len(one & two)} facets in common, which are already joined"
        )
        yield error("shared-facets", joint.contact.pair.tag, seen, "Name the surface of the other body.")


def turned_away(joint: Joint) -> Iterator[Finding]:
    """Surfaces on shells that look away from each other: shells have two sides."""
    if joint.contact.kind.name in ANY_DISTANCE:
        return
    turned = joint.facing().turned
    if turned:
        flips = " and ".join(f"<flip_{name}>1</flip_{name}>" for name in turned)
        seen = (
            f"no facet of surface '{joint.contact.pair.primary.name}' has surface "
            f"'{joint.contact.pair.secondary.name}' opposite it: the surfaces on shells face away from each other, "
            "and nothing is tied"
        )
        yield error("untied", joint.contact.pair.tag, seen, f"Set {flips}.")


def untied(joint: Joint) -> Iterator[Finding]:
    """Facets of the primary surface that see the other one from too far away; `sticky` waits for them."""
    if joint.contact.kind.name == STICKY:
        return
    gaps, limits = _gaps_and_limits(joint)
    seen = np.isfinite(gaps)
    pair = joint.contact.pair
    if not seen.any():
        yield error(
            "untied",
            pair.tag,
            f"no facet of surface '{pair.primary.name}' has surface '{pair.secondary.name}' in front of it or behind "
            "it: nothing is tied",
            "Select the faces that face each other.",
        )
        return
    far = seen & (np.abs(gaps) > limits)
    if not far.any():
        return
    given = joint.contact.given("search_radius")
    most = float(np.abs(gaps[far]).max())
    seen_from_afar = f"{int(far.sum())} of {int(seen.sum())} facets of surface '{pair.primary.name}'"
    made = error if far.sum() == seen.sum() else warning
    yield made(
        "untied",
        joint.contact.tag if given is None else given,
        f"{seen_from_afar} opposite the other surface are too far from it to be tied: up to {short(most)}",
        f"Set <search_radius> to {short(1.1 * most)} to tie them, or remove them from the surface.",
    )


def _gaps_and_limits(joint: Joint) -> tuple[Array, Array]:
    """Gaps at the centres of facets of the primary surface, and how large they may be; NaN where one sees nothing."""
    side, targets = joint.primary, rays.triangles(joint.secondary.facing_corners)
    pick = sample(len(side.centres), len(targets))
    gaps = side.look_at(targets, side.centres[pick], side.normals[pick])
    ours = joint.contact.kind.name == TIED
    given = joint.contact.value("search_radius", 0.0 if ours else DEFAULT_RADIUS)
    if joint.contact.kind.name in ANY_DISTANCE:
        given = joint.contact.value("max_distance", 0.0) or math.inf
    if not ours or given > 0.0:
        return gaps, np.full(len(gaps), given)
    edges = np.linalg.norm(side.corners[pick] - np.roll(side.corners[pick], -1, axis=1), axis=2).max(axis=1)
    return gaps, np.where(gaps < 0.0, joint.search_radius, np.minimum(AHEAD * edges, joint.search_radius))


def held_nodes(joint: Joint) -> Iterator[Finding]:
    """Primary nodes whose displacement is prescribed, or that another tie ties."""
    own = np.unique(joint.primary.surface.corners)
    model, contact = joint.model, joint.contact
    fixed = [model.nodes(each) for each in model.boundary if held_axes(each)]
    held = np.intersect1d(own, np.concatenate([np.empty(0, dtype=np.int64), *fixed]))
    if len(held):
        yield note(
            "held-nodes",
            contact.pair.tag,
            f"{len(held)} of {len(own)} nodes of the primary surface have a prescribed displacement and a "
            "condition of the tie: contradictory values have no solution",
            "None if the other surface has the same values. Otherwise exchange <primary> and <secondary>.",
        )
    others = [other for other in model.ties if other.tag is not contact.tag]
    shared = [np.intersect1d(own, other.pair.primary.corners) for other in others]
    count = len(np.unique(np.concatenate(shared))) if shared else 0
    if count and contact.method == METHODS.index("LAGMULT"):
        seen = (
            f"{count} nodes of the primary surface belong to another tie too. Both ties hold them, and the shares of "
            "their multipliers in the load are arbitrary"
        )
        yield warning("held-twice", contact.pair.tag, seen, "Make one surface of both, or use PENALTY or AUGLAG.")


def rigid_primary(joint: Joint) -> Iterator[Finding]:
    """A rigid primary surface that is finer than the one it is tied to."""
    if joint.secondary.rigid or not joint.primary.rigid:
        return
    nodes = [len(np.unique(side.surface.corners)) for side in joint.sides]
    if nodes[0] > nodes[1]:
        seen = (
            f"the primary surface is rigid and has {nodes[0]} nodes for {nodes[1]} of the secondary one: it has more "
            "conditions than the secondary nodes can meet"
        )
        yield warning("rigid-primary", joint.contact.pair.tag, seen, "Exchange <primary> and <secondary>.")


def linear_solver(joint: Joint) -> Iterator[Finding]:
    """Iterative linear solvers with multipliers or stiff penalties."""
    contact = joint.contact
    has_multipliers = contact.method == METHODS.index("LAGMULT")
    if contact.kind.name != TIED or not (has_multipliers or contact.given("penalty") is None):
        return
    why = (
        "<laugon>LAGMULT</laugon> makes the matrix indefinite" if has_multipliers else "the automatic penalty is stiff"
    )
    for tag in joint.model.of_solvers("linear_solver"):
        if tag.get("type") in ITERATIVE:
            seen = f"the linear solver '{tag.get('type')}' may find no solution: {why}"
            cure = "Use pardiso, mkl_dss or superlu_mt, or PENALTY with <auto_penalty> 1 and <penalty> 1000."
            yield warning("linear-solver", tag, seen, cure)


ON_TEXT = (
    settings.empty_contact,
    settings.unknown_parameter,
    settings.bad_value,
    settings.load_curve,
    settings.module,
    settings.material,
    settings.given_twice,
    settings.no_duration,
    linear_solver,
)
"""Rules that read the file alone."""
ON_SURFACES = (
    surfaces.empty_surface,
    surfaces.facet_of_no_element,
    surfaces.shell_facets,
    turned_away,
    surfaces.flat_facet,
    surfaces.inverted_facets,
    joined_facets,
)
ON_PHYSICS = (untied, held_nodes, rigid_primary, *cohesive.RULES)
"""Rules that need surfaces in order and numbers as values."""
