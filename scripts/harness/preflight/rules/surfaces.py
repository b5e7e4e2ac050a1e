"""Rules on surfaces: which way they face, and what they belong to."""

from collections.abc import Iterator

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from harness.arrays import Ids, Mask
from harness.preflight import rays
from harness.preflight.finding import Finding, error, note, warning
from harness.preflight.sides import Joint, Side, sample

SHARP = np.cos(np.radians(60.0))
"""Cosine of the angle between the normals of neighbouring facets from which the edge between them is sharp."""
OPPOSED = 0.1  # minus the cosine of the angle between the normals of two facets from which they can touch each other


def facet_of_no_element(joint: Joint) -> Iterator[Finding]:
    """Facets that are not a face of any element."""
    for side in joint.sides:
        lost = np.flatnonzero(~side.found)
        if len(lost) and not _on_shells(side):
            seen = f"surface '{side.surface.name}' has {_facets(len(lost))} on the face of no solid element"
            cure = "Select the surface again on the present mesh: a changed mesh has other node numbers."
            yield error("facet-of-no-element", side.surface.facet_tags[lost[0]], seen, cure)


def shell_facets(joint: Joint) -> Iterator[Finding]:
    """Surfaces on shells, of which these rules know no thickness; and back faces of what is no shell."""
    for side, name in zip(joint.sides, ("primary", "secondary"), strict=True):
        bottom = joint.contact.given(f"shell_bottom_{name}")
        if _on_shells(side):
            yield note(
                "shell-facets",
                side.surface.tag,
                f"surface '{side.surface.name}' lies on shell elements: distances and penalties were not checked",
                "None. Facets lie on the nodes; "
                f"<shell_bottom_{name}> moves them to the back faces, one thickness away.",
            )
        elif bottom is not None and joint.contact.on(f"shell_bottom_{name}") and side.found.all():
            seen = (
                f"<shell_bottom_{name}> is set, but surface '{side.surface.name}' lies on solid elements; the run stops"
            )
            yield error("shell-bottom", bottom, seen, f"Delete <shell_bottom_{name}>.")


def empty_surface(joint: Joint) -> Iterator[Finding]:
    """Surfaces without facets."""
    for side in joint.sides:
        if not len(side.surface.corners):
            seen = f"surface '{side.surface.name}' has no facets; FEBio stops"
            yield error("empty-surface", side.surface.tag, seen, "Select the faces that come into contact.")


def flat_facet(joint: Joint) -> Iterator[Finding]:
    """Facets without area and elements without volume."""
    for side in joint.sides:
        flat = np.flatnonzero(side.area <= 1e-12 * side.area.max(initial=0.0))
        thin = np.flatnonzero(side.found & ~(side.thickness > 0.0))
        if len(flat) or len(thin):
            which = int((flat if len(flat) else thin)[0])
            what = "has no area" if len(flat) else "belongs to an element of no volume"
            seen = f"a facet of surface '{side.surface.name}' {what}"
            cure = "Repair the mesh: nodes coincide or elements are collapsed."
            yield error("flat-facet", side.surface.facet_tags[which], seen, cure)


def inverted_facets(joint: Joint) -> Iterator[Finding]:
    """Facets whose nodes run the wrong way round."""
    for side, name in zip(joint.sides, ("primary", "secondary"), strict=True):
        flipped = joint.contact.on(f"flip_{name}")
        wrong = np.flatnonzero(side.found & (side.inverted != flipped))
        if not len(wrong):
            continue
        cure = "List the nodes of these facets counter-clockwise as seen from outside the body"
        if flipped:
            cure = f"Delete <flip_{name}>: the facets face outward without it"
        seen = (
            f"surface '{side.surface.name}' has {_facets(len(wrong))} facing into the body: the contact finds "
            "nothing there"
        )
        yield error("inverted-facets", side.surface.facet_tags[wrong[0]], seen, f"{cure}.")


def inner_facets(joint: Joint) -> Iterator[Finding]:
    """Facets inside a body, with elements on both sides."""
    for side in joint.sides:
        inside = np.flatnonzero([len(found) > 1 for found in side.behind])
        if len(inside):
            yield warning(
                "inner-facets",
                side.surface.facet_tags[inside[0]],
                f"surface '{side.surface.name}' has {_facets(len(inside))} inside a body, with elements on both sides",
                "Select the outer faces alone. Parts that slide must not share nodes.",
            )


def shared_facets(joint: Joint) -> Iterator[Finding]:
    """Primary and secondary surfaces that have facets or nodes in common."""
    one, two = ({tuple(sorted(set(row))) for row in side.surface.corners.tolist()} for side in joint.sides)
    common = len(one & two)
    pair = joint.contact.pair
    shared = f"surfaces '{pair.primary.name}' and '{pair.secondary.name}' have {_facets(common)} in common"
    inside = any(len(found) > 1 for side in joint.sides for found in side.behind)
    if common and joint.contact.kind.is_mixture and not inside:
        seen = f"{shared}, which may be in contact with each other: distances were not checked"
        yield note("self-contact", pair.tag, seen, "None if the body folds onto itself.")
        return
    if common:
        seen = f"{shared}, where nothing can slide"
        yield error("shared-facets", pair.tag, seen, "Name the surface of the other body.")
        return
    nodes = np.intersect1d(pair.primary.corners, pair.secondary.corners)
    if len(nodes):
        yield warning(
            "shared-nodes",
            pair.tag,
            f"surfaces '{pair.primary.name}' and '{pair.secondary.name}' share {len(nodes)} nodes: the bodies "
            "cannot separate or slide there",
            "Give each body its own nodes at the contact, or remove the shared part from one surface.",
        )


def own_body(joint: Joint) -> Iterator[Finding]:
    """Both surfaces on one body."""
    pair = joint.contact.pair
    shared_nodes = len(np.intersect1d(pair.primary.corners, pair.secondary.corners)) > 0
    if not shared_nodes and joint.primary.bodies & joint.secondary.bodies:
        yield warning(
            "own-body",
            pair.tag,
            f"surfaces '{pair.primary.name}' and '{pair.secondary.name}' belong to one body: elements connect them",
            "If you model two bodies, one surface is on the wrong body, or their meshes are merged. "
            "A body that folds onto itself needs no change.",
        )


def facing(joint: Joint) -> Iterator[Finding]:
    """Surfaces that do not face each other anywhere."""
    if not all(len(side.surface.corners) for side in joint.sides) or any(side.inverted.any() for side in joint.sides):
        return
    if any(side.at_back for side in joint.sides):
        return
    if any(_sees(side, other)[1].any() for side, other in (joint.sides, joint.sides[::-1])):
        return
    pair = joint.contact.pair
    surfaces = f"surfaces '{pair.primary.name}' and '{pair.secondary.name}'"
    if _opposed(*joint.sides):
        seen = f"{surfaces} are not opposite each other at the start: contact needs a sideways movement"
        yield note("facing", pair.tag, seen, "None if a body moves in this way.")
        return
    one, two = (side.areas.sum(axis=0) for side in joint.sides)
    same = float(one @ two) > 0.3 * float(np.linalg.norm(one) * np.linalg.norm(two))
    where = "point the same way" if same else "do not face each other"
    seen = f"{surfaces} {where}: no facet of one surface faces a facet of the other, and there is no contact"
    cure = "One surface is probably on the wrong side of its body. Select the faces that face each other."
    yield error("facing", pair.tag, seen, cure)


def side_faces(joint: Joint) -> Iterator[Finding]:
    """Faces of a body beyond a sharp edge that never look at the other body."""
    for side, other in (joint.sides, joint.sides[::-1]):
        if not len(side.surface.corners) or not len(other.surface.corners):
            continue
        patches = _patches(side)
        counted, seen = _sees(side, other)
        share = [float(seen[patches[counted] == patch].mean()) for patch in np.unique(patches[counted])]
        blind = [k for k, part in enumerate(share) if part < 0.1]
        if blind and max(share) > 0.5:
            names = np.unique(patches[counted])
            facets = np.flatnonzero(np.isin(patches, names[blind]))
            yield note(
                "side-faces",
                side.surface.facet_tags[facets[0]],
                f"surface '{side.surface.name}' has {_facets(len(facets))} beyond a sharp edge or on another side, "
                "which face away from the other body. A porous body has the ambient values there",
                "Remove side and far faces from the surface, unless they shall have the ambient values.",
            )


# ---- geometry ----


def _sees(side: Side, other: Side) -> tuple[Ids, Mask]:
    """Some facets of a side, and which of them have a facet of the other side in front, or behind in overlap."""
    targets = rays.triangles(other.corners)
    pick = sample(len(side.centres), len(targets))
    return pick, np.isfinite(side.look_at(targets, side.centres[pick], side.normals[pick]))


def _opposed(one: Side, two: Side) -> bool:
    """Whether some facets of two sides have opposite normals, so that the bodies can meet there."""
    first, second = (side.normals[sample(len(side.normals), 1)] for side in (one, two))
    return bool((first @ second.T < -OPPOSED).any())


def _patches(side: Side) -> Ids:
    """Number of the smooth patch that each facet belongs to: patches end at sharp convex edges."""
    one, two = _neighbours(side)
    flat = np.einsum("ei,ei->e", side.normals[one], side.normals[two]) > SHARP
    away = side.centres[two] - side.centres[one]
    concave = np.einsum("ei,ei->e", away, side.normals[one]) > 0.0
    keep = flat | concave
    count = len(side.centres)
    graph = coo_array((np.ones(int(keep.sum()), dtype=np.int8), (one[keep], two[keep])), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def _neighbours(side: Side) -> tuple[Ids, Ids]:
    """Pairs of facets that share an edge."""
    corners = side.surface.corners
    ends = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=2), axis=2)
    facet = np.repeat(np.arange(len(corners)), 4)
    edges = ends.reshape(-1, 2)
    real = edges[:, 0] != edges[:, 1]
    edges, facet = edges[real], facet[real]
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    edges, facet = edges[order], facet[order]
    same = np.flatnonzero((edges[1:] == edges[:-1]).all(axis=1))
    return facet[same], facet[same + 1]


def _on_shells(side: Side) -> bool:
    """Whether the facets that no solid element has are elements of a shell."""
    shells = [block.nodes for block in side.model.mesh.blocks if not block.solid and block.shape.nodes >= 3]
    nodes = np.unique(np.concatenate([np.unique(block) for block in shells])) if shells else np.empty(0, dtype=int)
    lost = side.surface.corners[~side.found]
    return bool(len(lost) and np.isin(lost, nodes).all())


def _facets(count: int) -> str:
    return "one facet" if count == 1 else f"{count} facets"


RULES = (
    empty_surface,
    facet_of_no_element,
    shell_facets,
    flat_facet,
    inverted_facets,
    inner_facets,
    shared_facets,
    own_body,
    facing,
    side_faces,
)
