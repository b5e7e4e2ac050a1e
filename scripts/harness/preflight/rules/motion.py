"""Rules on rigid-body motion: is each body held, before it touches and after?"""

from collections.abc import Iterator

import numpy as np

from harness.arrays import Array, Mask
from harness.preflight.finding import Finding, short, warning
from harness.preflight.model import Condition, Model
from harness.preflight.sides import Joint, Side
from harness.preflight.xml_file import Element, children, chosen, flag, text

AXES = ("x", "y", "z")
ANALYSES = ("STATIC", "DYNAMIC")
SMALL = 1e-6  # singular value, relative to the largest, that counts as zero
MOST_ROWS = 3000  # so many nodes of a set are looked at
_NOT_MECHANICAL = ("pressure", "concentration", "temperature", "shell", "fluid")
_RIGID_DOFS = ("Rx", "Ry", "Rz", "Ru", "Rv", "Rw")


def rigid_modes(joint: Joint) -> Iterator[Finding]:
    """Bodies that nothing holds: at all, or until they touch."""
    model = joint.model
    if any(chosen(text(tag), ANALYSES) == 1 for control in model.controls for tag in children(control, "analysis")):
        return
    apart = not joint.smallest_gap < 0.0
    for side in joint.sides:
        if len(side.bodies) != 1 or _held_otherwise(joint, side):
            continue
        held = _constraints(model, side)
        free = free_motions(held)
        if not free:
            continue
        rubbing = joint.contact.has_friction
        touching = free_motions(np.concatenate([held, _contact_rows(side, _centre(model, side), rubbing)]))
        if touching:
            yield warning(
                "rigid-motion",
                side.surface.tag,
                f"nothing holds the body of surface '{side.surface.name}' against motion {_and(touching)}, and the "
                "contact does not either: the matrix is singular, and any load moves the body away",
                "Add a boundary condition that holds it, or a weak spring.",
            )
        elif apart:
            yield warning(
                "rigid-motion",
                side.surface.tag,
                f"nothing holds the body of surface '{side.surface.name}' against motion {_and(free)} before it "
                f"touches: {_distance(joint.smallest_gap)} at the start, and the first load moves the body away",
                "Start with a small overlap, about the compression under the load, or move the body by a prescribed "
                "displacement until it touches.",
            )


def free_motions(rows: Array) -> list[str]:
    """Rigid motions that constraints leave free, in words.

    rows: shape (n, 6), each row r holds r . (translation, rotation about the body's centre over its size).
    """
    if not len(rows):
        return ["in all directions"]
    values, vectors = np.linalg.eigh(rows.T @ rows)
    kernel = vectors.T[values <= SMALL**2 * values[-1]]
    if not len(kernel):
        return []
    words = [f"along {AXES[k]}" for k in range(3) if np.linalg.norm(kernel[:, k]) > 1.0 - 1e-6]
    oblique = len(kernel) > len(words)
    turning = bool(np.abs(kernel[:, 3:]).max() > 1e-6)
    return [*words, *(["in rotation"] if turning else ["in an oblique direction"] if oblique else [])]


def _distance(gap: float) -> str:
    if not np.isfinite(gap):
        return "the surfaces are not in front of each other"
    return f"the surfaces are {short(gap)} apart" if gap > 0.0 else "the surfaces just touch, without overlap,"


def _and(words: list[str]) -> str:
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def _centre(model: Model, side: Side) -> tuple[Array, float]:
    points = model.mesh.points[_body_nodes(model, side)]
    size = float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
    return points.mean(axis=0), size or 1.0


def _body_nodes(model: Model, side: Side) -> Mask:
    return np.asarray(np.isin(model.mesh.bodies, list(side.bodies)))


def _row(points: Array, axes: Array, centre: tuple[Array, float]) -> Array:
    """Constraints of points (n, 3) along axes (n, 3)."""
    arms = (points - centre[0]) / centre[1]
    return np.concatenate([axes, np.cross(arms, axes)], axis=1)


def _contact_rows(side: Side, centre: tuple[Array, float], rubbing: bool) -> Array:
    """What full contact holds: the normal motion of the corners of each facet, and with friction every motion."""
    step = max(1, len(side.centres) // MOST_ROWS)
    corners, normals = side.corners[::step].reshape(-1, 3), side.normals[::step].repeat(4, axis=0)
    if not rubbing:
        return _row(corners, normals, centre)
    return np.concatenate([_row(corners, np.broadcast_to(axis, corners.shape), centre) for axis in np.eye(3)])


def _constraints(model: Model, side: Side) -> Array:
    own, centre = _body_nodes(model, side), _centre(model, side)
    rows = [np.empty((0, 6))]
    for condition in model.boundary:
        axes = held_axes(condition)
        if not axes or condition.step > 1:
            continue
        nodes = model.nodes(condition)
        nodes = nodes[own[nodes]]
        points = model.mesh.points[nodes[:: max(1, len(nodes) // MOST_ROWS)]]
        rows += [_row(points, np.tile(np.eye(3)[axis], (len(points), 1)), centre) for axis in axes]
    rows += [_rigid_rows(tag) for tag in _rigid_conditions(model, side)]
    return np.concatenate(rows)


def held_axes(condition: Condition) -> list[int]:
    """Axes that a boundary condition holds; all three where its type is not one that is known here."""
    if condition.kind == "zero displacement":
        return [k for k, axis in enumerate(AXES) if flag(condition.tag, f"{axis}_dof")]
    if condition.kind == "prescribed displacement":
        dof = condition.tag.find("dof")
        name = "x" if dof is None else text(dof)
        return [AXES.index(name)] if name in AXES else [int(name)] if name in ("0", "1", "2") else []
    if any(word in condition.kind for word in _NOT_MECHANICAL) or condition.tag.get("node_set") is None:
        return []
    return [0, 1, 2]


def _rigid_conditions(model: Model, side: Side) -> Iterator[Element]:
    """Rigid boundary conditions on a rigid material of the side's body."""
    faces = model.mesh.faces
    own = np.isin(model.mesh.bodies[faces.corners[:, 0]], list(side.bodies))
    blocks = np.unique(faces.block[faces.element[own]])
    names = {material.name for k in blocks if (material := model.block_materials[int(k)]) and material.rigid}
    for step, tag in model.document.everywhere("Rigid", "rigid_bc"):
        body = tag.find("rb")
        if step <= 1 and body is not None and text(body) in names:
            yield tag


def _rigid_rows(tag: Element) -> Array:
    """Rows of one rigid boundary condition; types that are not known here hold all."""
    kind = tag.get("type")
    if kind == "rigid_fixed":
        return np.eye(6)[[flag(tag, f"{dof}_dof") for dof in _RIGID_DOFS]]
    dof = tag.find("dof")
    if kind in ("rigid_displacement", "rigid_rotation") and dof is not None:
        place = _RIGID_DOFS.index(text(dof)) if text(dof) in _RIGID_DOFS else -1
        place = "xyz".index(text(dof)) if text(dof) in AXES else place
        return np.eye(6)[[place]] if place >= 0 else np.eye(6)
    return np.eye(6)


def _held_otherwise(joint: Joint, side: Side) -> bool:
    """Whether springs, constraints, rigid connectors or other contacts may hold a body: then nothing is said."""
    model = joint.model
    if any(True for name in ("Constraints", "Discrete") for _ in model.document.everywhere(name)):
        return True
    if any(True for _ in model.document.everywhere("Rigid", "rigid_connector")):
        return True
    others = [pair for pair in model.contact_pairs if pair.name != joint.contact.pair.name]
    surfaces = [surface for pair in others for surface in (pair.primary, pair.secondary)]
    return any(np.isin(model.mesh.bodies[surface.corners], list(side.bodies)).any() for surface in surfaces)


RULES = (rigid_modes,)
