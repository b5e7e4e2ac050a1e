"""A contact with the geometry and the materials on both of its sides, as the rules look at it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

import numpy as np

from harness.arrays import Array, Ids, Mask
from harness.preflight import elements, rays
from harness.preflight.contact_types import UNLIMITED_SEARCH
from harness.preflight.materials import Material
from harness.preflight.mesh_section import Surface
from harness.preflight.model import Contact, Model

MOST_FACETS, LEAST_FACETS, MOST_PAIRS = 1000, 100, 10_000_000
"""So many facets of a surface are looked at for gaps; fewer where the other surface has many. Of larger surfaces every
n-th is."""
NEAREST = 20  # so many facets are looked at closely
MOST_DEPTHS = 40  # so many facets are looked at for the depth of the body behind them
SIDES = ("primary", "secondary")
DEFAULT_RADIUS = 1.0  # `search_radius` of FEBio's interfaces where the model does not give it


@dataclass(frozen=True)
class Side:
    """One surface of a contact."""

    model: Model
    surface: Surface
    turned: bool = False  # whether the contact turns its facets round
    at_back: bool = False  # whether it is the back faces of shells, which lie a thickness behind these nodes

    @cached_property
    def corners(self) -> Array:
        """Positions, shape (n_facets, 4, 3)."""
        return np.asarray(self.model.mesh.points[self.surface.corners])

    @cached_property
    def facing_corners(self) -> Array:
        """The same in the order that the contact takes."""
        return self.corners[:, ::-1] if self.turned else self.corners

    @cached_property
    def areas(self) -> Array:
        """Area vectors in the order of the nodes that the contact takes, shape (n_facets, 3)."""
        return elements.area_vectors(self.corners) * (-1.0 if self.turned else 1.0)

    @cached_property
    def area(self) -> Array:
        """Areas of the facets."""
        return np.asarray(np.linalg.norm(self.areas, axis=1))

    @cached_property
    def normals(self) -> Array:
        """Unit normals; zero for facets of no area."""
        return np.asarray(self.areas / np.maximum(self.area, np.finfo(float).tiny)[:, None])

    @cached_property
    def centres(self) -> Array:
        """Means of the corners."""
        return np.asarray(self.corners.mean(axis=1))

    @cached_property
    def behind(self) -> list[Ids]:
        """Faces of volume elements on each facet."""
        return self.model.mesh.faces.behind(self.surface.corners)

    @cached_property
    def face(self) -> Ids:
        """One face of a volume element for each facet, -1 where there is none."""
        return np.array([found[0] if len(found) else -1 for found in self.behind], dtype=np.int64)

    @cached_property
    def found(self) -> Mask:
        """Facets with a volume element behind them."""
        return self.face >= 0

    @cached_property
    def inverted(self) -> Mask:
        """Facets whose nodes run clockwise seen from outside their element; not those inside a body."""
        faces = self.model.mesh.faces
        alone = np.array([len(found) == 1 for found in self.behind], dtype=bool)
        outward = elements.area_vectors(self.model.mesh.points[faces.corners[self.face[alone]]])
        against = np.einsum("fi,fi->f", outward, self.areas[alone]) < 0.0
        inverted = np.zeros(len(alone), dtype=bool)
        inverted[alone] = against
        return inverted

    @cached_property
    def thickness(self) -> Array:
        """Volume of the element over the area of the facet, mm; NaN without an element."""
        faces = self.model.mesh.faces
        thickness = np.full(len(self.face), math.nan)
        known = self.found & (self.area > 0.0)
        thickness[known] = np.abs(faces.volume[faces.element[self.face[known]]]) / self.area[known]
        return thickness

    @cached_property
    def materials(self) -> list[Material | None]:
        """Material behind each facet."""
        faces, known = self.model.mesh.faces, self.model.block_materials
        return [known[faces.block[faces.element[face]]] if face >= 0 else None for face in self.face]

    @cached_property
    def kinds(self) -> list[Material]:
        """The different materials behind the surface."""
        return list({id(material): material for material in self.materials if material is not None}.values())

    @property
    def porous(self) -> bool:
        """Whether there is fluid on this side."""
        return any(material.porous for material in self.kinds)

    @property
    def rigid(self) -> bool:
        """Whether this side is rigid."""
        return bool(self.kinds) and all(material.rigid for material in self.kinds)

    @property
    def solutes(self) -> set[int]:
        """Numbers of the solutes on this side."""
        return {number for material in self.kinds for number in material.solutes}

    @cached_property
    def bodies(self) -> set[int]:
        """Numbers of the bodies that the surface belongs to."""
        return {int(body) for body in np.unique(self.model.mesh.bodies[self.surface.corners])}

    def depths(self, origins: Array, normals: Array) -> Array:
        """How far behind these places of the surface, along its normals, the surface ends its body, mm; NaN where it
        does not.
        """
        least = np.full(len(origins), 1e-6 * float(np.linalg.norm(np.ptp(self.corners, axis=(0, 1)))))
        return rays.first_exit(origins, -normals, rays.triangles(self.corners), least)

    def look_at(self, targets: Array, origins: Array, normals: Array) -> Array:
        """Distances (mm) of triangles of another surface that these places see: nothing through the own body."""
        return rays.nearest_facing(origins, normals, targets, self.depths(origins, normals))

    def conductances(self, field: Field) -> Array:
        """Stiffness or conductance per facet: property over thickness."""
        values = np.array([math.nan if m is None else field.property_of(m) for m in self.materials])
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(values / self.thickness)

    def resistance(self, field: Field) -> float:
        """L/G of the part of the body that has the field: its depth behind the surface times the mean of 1/G over its
        volume. 0 for a rigid side; NaN where a property is no number.
        """
        if not self.kinds:
            return math.nan
        if all(math.isinf(field.property_of(material)) for material in self.kinds):
            return 0.0
        own = self._elements_with(field)
        return self._depth(own) * self._mean_resistivity(field, own)

    @cached_property
    def depth(self) -> float:
        """Depth of the deformable part of the body behind the surface, mm."""
        return self._depth(self._elements_with(TRACTION))

    def _elements_with(self, field: Field) -> Mask:
        """Volume elements of the surface's bodies whose property is neither zero nor infinite, shape (n_elements,)."""
        faces, bodies = self.model.mesh.faces, self.model.mesh.bodies
        chosen = [k for k, m in enumerate(self.model.block_materials) if m is None or _limited(field.property_of(m))]
        own = np.zeros(len(faces.volume), dtype=bool)
        own[faces.element] = np.isin(bodies[faces.corners[:, 0]], list(self.bodies))
        return np.asarray(own & np.isin(faces.block, chosen))

    def _depth(self, own: Mask) -> float:
        """Median depth of these elements along the inward normal; their thickness where no ray leaves them."""
        faces = self.model.mesh.faces
        targets = rays.triangles(self.model.mesh.points[faces.corners[faces.outer(own)]])
        step = max(1, len(self.centres) // MOST_DEPTHS)
        pick = np.flatnonzero(self.found)[::step]
        inward = np.where(self.inverted[pick, None], 1.0, -1.0) * self.normals[pick]
        depths = rays.first_exit(self.centres[pick], inward, targets, 0.01 * self.thickness[pick])
        known = depths[np.isfinite(depths)]
        return float(np.median(known)) if len(known) else float(np.nanmedian(self.thickness))

    def _mean_resistivity(self, field: Field, own: Mask) -> float:
        """Mean of 1/G over the volume of these elements."""
        faces, known = self.model.mesh.faces, self.model.block_materials
        values = np.array([math.nan if material is None else field.property_of(material) for material in known])
        volumes = np.abs(faces.volume[own])
        return float((volumes / values[faces.block[own]]).sum() / volumes.sum()) if own.any() else math.nan


def _limited(value: float) -> bool:
    """Whether a property is neither zero nor infinite; one that is no number may be anything."""
    return math.isnan(value) or 0.0 < value < math.inf


@dataclass(frozen=True)
class Field:
    """What a contact exchanges, and the parameter of its penalty."""

    name: str  # in plain words
    penalty: str
    tolerance: str  # parameter of the absolute tolerance
    solute: int = 0  # number of the solute; 0 for others

    def property_of(self, material: Material) -> float:
        """Modulus, permeability or phi_w kappa~ d."""
        if self.solute:
            return material.solute_conductivity(self.solute)
        return material.permeability if self is SOLVENT else material.modulus


TRACTION = Field("traction", "penalty", "gaptol")
SOLVENT = Field("fluid pressure", "pressure_penalty", "ptol")


def solute(number: int) -> Field:
    """The field of a solute."""
    return Field(f"concentration of solute {number}", "concentration_penalty", "ctol", number)


@dataclass(frozen=True)
class Joint:
    """A contact with its two sides; those in `turned` are looked at the other way round."""

    model: Model
    contact: Contact
    turned: tuple[str, ...] = ()

    @cached_property
    def primary(self) -> Side:
        """Side of the primary surface."""
        return self._side(self.contact.pair.primary, "primary")

    @cached_property
    def secondary(self) -> Side:
        """Side of the secondary surface."""
        return self._side(self.contact.pair.secondary, "secondary")

    def _side(self, surface: Surface, which: str) -> Side:
        on = self.contact.on
        return Side(self.model, surface, on(f"flip_{which}") != (which in self.turned), on(f"shell_bottom_{which}"))

    @property
    def sides(self) -> tuple[Side, Side]:
        """Both."""
        return self.primary, self.secondary

    @cached_property
    def fields(self) -> tuple[Field, ...]:
        """What it exchanges: it follows from the type, the materials on both sides, and <effects>."""
        kind = self.contact.kind
        found = [TRACTION]
        if kind.solvent and all(side.porous for side in self.sides) and self.contact.asks_for("solvent"):
            found.append(SOLVENT)
        if kind.solutes:
            shared = sorted(self.primary.solutes & self.secondary.solutes)
            found += [solute(number) for number in shared if self._asks_for_solute(number)]
        if kind.is_mixture and self.contact.lacks("penalty"):
            return ()
        return tuple(field for field in found if not (kind.is_mixture and self.contact.lacks(field.penalty)))

    def _asks_for_solute(self, number: int) -> bool:
        own = [name for name, known in self.model.solutes.items() if known == number and not name.isdigit()]
        return self.contact.asks_for("solutes", f"solute {number}", *own)

    @cached_property
    def gaps(self) -> Array:
        """Gaps of facets of the primary surface along their normals, negative where they overlap; NaN where a facet
        sees nothing. At the centres of facets, and at the corners of the nearest ones.
        """
        side, targets = self.primary, rays.triangles(self.secondary.facing_corners)
        pick = sample(len(side.centres), len(targets))
        centres = side.look_at(targets, side.centres[pick], side.normals[pick])
        near = pick[np.argsort(np.where(np.isnan(centres), np.inf, centres))[:NEAREST]]
        normals = side.normals[near].repeat(4, axis=0)
        corners = side.look_at(targets, side.corners[near].reshape(-1, 3), normals)
        return np.concatenate([centres, corners])

    def facing(self) -> Joint:
        """The contact with sides of shells turned round where the primary surface would see nothing else."""
        shells = [name for name, side in zip(SIDES, self.sides, strict=True) if not side.found.any()]
        ways = [self, *(replace(self, turned=chosen) for n in (1, 2) for chosen in combinations(shells, n))]
        return next((way for way in ways if np.isfinite(way.gaps).any()), self)

    @property
    def largest_gap(self) -> float:
        """The largest distance or overlap, of facets that see the other surface; 0 where none does."""
        known = self.gaps[np.isfinite(self.gaps)]
        return float(np.abs(known).max(initial=0.0))

    @cached_property
    def smallest_gap(self) -> float:
        """Smallest gap, negative for overlap; NaN where no facet sees the other side. Overlaps beyond the search radius
        are what lies behind a body, and do not count.
        """
        known = self.gaps[self.gaps >= -self.search_radius]
        return float(known.min()) if len(known) else math.nan

    @cached_property
    def search_radius(self) -> float:
        """In effect: given, or half the diagonal of the box around the smaller surface, or FEBio's 1, 0 or no limit."""
        kind = self.contact.kind
        unlimited = kind.name in UNLIMITED_SEARCH
        given = self.contact.value("search_radius", 0.0 if unlimited or kind.is_mixture else DEFAULT_RADIUS)
        if kind.is_mixture and given == 0.0:
            return min(_diagonal(side) for side in self.sides) / 2.0
        return math.inf if unlimited and given == 0.0 else given

    @cached_property
    def thickness(self) -> float:
        """Median thickness of the deformable elements at the contact, mm."""
        values = np.concatenate([side.thickness for side in self.sides if not side.rigid] or [self.primary.thickness])
        return float(np.nanmedian(values)) if np.isfinite(values).any() else math.nan


def sample(count: int, targets: int) -> Ids:
    """Which of `count` facets to look at, when each is compared with so many targets."""
    most = min(MOST_FACETS, max(LEAST_FACETS, MOST_PAIRS // max(1, targets)))
    return np.arange(0, count, max(1, -(-count // most)), dtype=np.int64)


def _diagonal(side: Side) -> float:
    points = side.corners.reshape(-1, 3)
    return float(np.linalg.norm(points.max(axis=0) - points.min(axis=0))) if len(points) else 0.0
