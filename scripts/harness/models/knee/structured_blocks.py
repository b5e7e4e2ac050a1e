"""Hexahedral meshes of the knee's bodies, each one structured block, and the distance between them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from harness.arrays import Array, Ids
from harness.models.knee import anatomy
from harness.models.knee.anatomy import Compartment

_SIGNS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])  # parameters of a quadrilateral's corners
_SAMPLES = 7  # points along each edge at which a facet is compared
_NEAREST = 5  # facets among which the one below or above a point is looked for
_ITERATIONS = 4  # of Newton's method for the parameters of a point: facets are near to parallelograms


def smallest_gap(lower: Array, upper: Array) -> float:
    """Smallest distance along z between two surfaces, mm; negative where they overlap.

    lower, upper: shape (n_facets, 4, 3), corners of the facets, of surfaces that are heights over x and y.
    """
    below, above = _points(lower), _points(upper)
    gaps = np.concatenate([_heights(upper, below) - below[:, 2], above[:, 2] - _heights(lower, above)])
    return float(np.nanmin(gaps))


def _points(facets: Array) -> Array:
    """Points all over the facets, shape (n, 3)."""
    line = np.linspace(-1.0, 1.0, _SAMPLES)
    at = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    return np.asarray(np.einsum("pa,fai->fpi", _shapes(at), facets).reshape(-1, 3))


def _heights(facets: Array, points: Array) -> Array:
    """Height of a surface at the x and y of points; NaN beside the surface."""
    number = min(_NEAREST, len(facets))
    _, nearest = cKDTree(facets[:, :, :2].mean(axis=1)).query(points[:, :2], k=range(1, number + 1))
    found = np.full(len(points), np.nan)
    for candidates in np.asarray(nearest).T:
        missing = np.flatnonzero(np.isnan(found))
        facet = facets[candidates[missing]]
        at = _parameters(facet[:, :, :2], points[missing, :2])
        inside = np.abs(at).max(axis=1) <= 1.0 + 1e-9
        found[missing[inside]] = np.einsum("na,na->n", _shapes(at), facet[:, :, 2])[inside]
    return found


def _parameters(corners: Array, points: Array) -> Array:
    """Parameters of points in the quadrilaterals with these corners, shape (n, 2)."""
    at = np.zeros_like(points)
    for _ in range(_ITERATIONS):
        (a, b), (c, d) = np.einsum("nai,naj->ijn", corners, _slopes(at))
        x, y = (points - np.einsum("na,nai->ni", _shapes(at), corners)).T
        at += np.stack([d * x - b * y, a * y - c * x], axis=1) / (a * d - b * c)[:, None]
    return at


def _shapes(at: Array) -> Array:
    """Shape functions, shape (n, 4)."""
    return np.asarray(np.prod(1.0 + at[:, None] * _SIGNS, axis=2) / 4.0)


def _slopes(at: Array) -> Array:
    """Their derivatives, shape (n, 4, 2)."""
    factors = 1.0 + at[:, None] * _SIGNS
    return np.asarray(factors[:, :, ::-1] * _SIGNS / 4.0)


ROUNDNESS = 0.5  # of the plateau's corners: the elements there keep more than half of their angles


TOUCH = 1e-3  # overlap with which femur and tibia touch, mm


def even(layers: int) -> Array:
    """Depths of layers of one thickness as parts of the whole, from the deepest to the surface."""
    return np.linspace(1.0, 0.0, layers + 1)


def graded(layers: int) -> Array:
    """The same of layers that are thinner towards both sides."""
    return np.asarray(0.5 + 0.5 * np.cos(np.pi * np.linspace(0.0, 1.0, layers + 1)))


@dataclass(frozen=True)
class Divisions:
    """Numbers of elements."""

    # Eighths of the cartilage around the axis of flexion, across it, and through the cartilage.
    condyle: tuple[int, int, int]
    plateau: tuple[int, int, int]  # across, along, and through the cartilage
    meniscus: tuple[int, int, int]  # around, from the rim to the inner edge, and through its height
    depths: Callable[[int], Array] = even  # depths of the layers through cartilage and menisci, from their number

    @property
    def seat(self) -> float:
        """How deep the femur overlaps the tibia at the start, mm.

        Three times what the arcs of a condyle rise over the edges of its elements: a load that the femur moves under
        finds resistance in the first iteration.
        """
        around = (anatomy.BACK + anatomy.FRONT) / (8 * self.condyle[0]) * anatomy.SAGITTAL
        across = 2.0 * anatomy.SIDE / self.condyle[1] * anatomy.CORONAL
        return float(3.0 * (around**2 / (8.0 * anatomy.SAGITTAL) + across**2 / (8.0 * anatomy.CORONAL)))


@dataclass(frozen=True)
class Fit:
    """Where the bodies of a compartment are at the start."""

    seat: float  # how deep the femur overlaps the tibia, mm
    # Gaps between the meniscus and the smooth surfaces of femur and tibia, mm.
    above: float = anatomy.PLAY
    below: float = anatomy.PLAY


@dataclass(frozen=True)
class Block:
    """A structured block whose third direction goes from bone to cartilage, or up."""

    points: Array  # shape (n_i + 1, n_j + 1, n_k + 1, 3)
    bone: int = 0  # layers of elements of bone, the first ones along the third direction
    first: int = 1  # number of the block's first node, from 1

    @property
    def nodes(self) -> Ids:
        """Node numbers, shape (n_i + 1, n_j + 1, n_k + 1)."""
        return self.first + np.arange(self.points[..., 0].size, dtype=np.int64).reshape(self.points.shape[:3])

    def elements(self, layers: slice) -> Ids:
        """Elements of some layers in FEBio's order of hex8, shape (n, 8)."""
        below, above = self._faces(slice(None, -1)), self._faces(slice(1, None))
        return np.concatenate([below, above], axis=-1)[:, :, layers].reshape(-1, 8)

    def corners(self, facets: Ids) -> Array:
        """Positions of the nodes of facets, shape (n, 4, 3)."""
        return np.asarray(self.points.reshape(-1, 3)[facets - self.first])

    @property
    def top(self) -> Ids:
        """Facets of the last layer, counterclockwise seen from outside."""
        return self._faces(slice(-1, None)).reshape(-1, 4)

    @property
    def bottom(self) -> Ids:
        """Facets of the first layer, counterclockwise seen from outside."""
        return self._faces(slice(0, 1)).reshape(-1, 4)[:, ::-1]

    @property
    def sides(self) -> Ids:
        """Nodes of cartilage or meniscus on the other four faces, each once, without those of bone."""
        nodes = self.nodes[:, :, self.bone + 1 if self.bone else 0 :]
        return np.unique(np.concatenate([nodes[[0, -1]].ravel(), nodes[:, [0, -1]].ravel()]))

    def _faces(self, layers: slice) -> Ids:
        """Nodes of the quadrilaterals in some layers of nodes, shape (n_i, n_j, n_layers, 4)."""
        n = self.nodes[:, :, layers]
        return np.stack([n[:-1, :-1], n[1:, :-1], n[1:, 1:], n[:-1, 1:]], axis=-1)


def femur(side: Compartment, divisions: Divisions, fit: Fit) -> Block:
    """Cartilage of a condyle with a layer of bone above it."""
    around, across, through = divisions.condyle
    angle = np.linspace(-anatomy.BACK, anatomy.FRONT, 8 * around + 1)
    sideways = np.linspace(-anatomy.SIDE, anatomy.SIDE, across + 1)
    depth = anatomy.FEMORAL_CARTILAGE * divisions.depths(through)
    depth = np.concatenate([[anatomy.FEMORAL_CARTILAGE + anatomy.BONE], depth])
    points = anatomy.condyle(*np.meshgrid(angle, sideways, depth, indexing="ij"))
    return Block(_at(side, points - [0.0, 0.0, fit.seat]), bone=1)


def tibia(side: Compartment, divisions: Divisions) -> Block:
    """Cartilage of a plateau with a layer of bone below it."""
    across, along, through = divisions.plateau
    depth = anatomy.TIBIAL_CARTILAGE * divisions.depths(through)
    depth = np.concatenate([[anatomy.TIBIAL_CARTILAGE + anatomy.BONE], depth])
    square = np.meshgrid(np.linspace(-1.0, 1.0, across + 1), np.linspace(-1.0, 1.0, along + 1), depth, indexing="ij")
    u, v = anatomy.rounded(square[0], square[1], ROUNDNESS)
    x, y = anatomy.PLATEAU_WIDTH * u, side.length * v
    return Block(_at(side, np.stack([x, y, side.plateau(x, y) - square[2]], axis=-1)), bone=1)


def meniscus(side: Compartment, divisions: Divisions, fit: Fit) -> Block:
    """A wedge around the contact of a condyle and a plateau, open to the middle of the knee; its fibres go around."""
    around, across, through = divisions.meniscus
    middle = 0.0 if side.inwards > 0 else np.pi
    angle = middle + np.linspace(side.opening, 2.0 * np.pi - side.opening, around + 1)
    angle, inset, up = np.meshgrid(
        angle, side.width * np.linspace(0.0, 1.0, across + 1), divisions.depths(through)[::-1], indexing="ij"
    )
    x, y = (side.rim[0] - inset) * np.cos(angle), (side.rim[1] - inset) * np.sin(angle)
    low, high = side.plateau(x, y) + fit.below, anatomy.condyle_height(x, y) - fit.seat - fit.above
    return Block(_at(side, np.stack([x, y, low + up * (high - low)], axis=-1)))


def compartment(side: Compartment, divisions: Divisions, fit: Fit) -> list[Block]:
    """Femur, tibia and meniscus."""
    return [femur(side, divisions, fit), tibia(side, divisions), meniscus(side, divisions, fit)]


def touching(side: Compartment, divisions: Divisions) -> Fit:
    """Where bodies touch: the femur overlaps the tibia by `TOUCH`, and the meniscus neither of them."""
    smooth = Fit(0.0)
    upper, lower, between = compartment(side, divisions, smooth)
    seat = TOUCH + smallest_gap(lower.corners(lower.top), upper.corners(upper.top))
    above = smallest_gap(between.corners(between.top), upper.corners(upper.top))
    below = smallest_gap(lower.corners(lower.top), between.corners(between.bottom))
    return Fit(seat, smooth.above - above, smooth.below - below)


def numbered(blocks: Sequence[Block]) -> list[Block]:
    """The blocks with node numbers that follow each other."""
    ends = np.cumsum([0, *(block.points[..., 0].size for block in blocks)])
    return [Block(block.points, block.bone, 1 + int(start)) for block, start in zip(blocks, ends[:-1], strict=True)]


def _at(side: Compartment, points: Array) -> Array:
    return np.asarray(points + np.array([side.centre, 0.0, 0.0]))
