"""Reads FEBio's plot file (.xplt) with pyfebio's reader, into memory."""

import struct
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pyfebio import xplt

from harness.arrays import Array, Ids
from harness.errors import DataFileError
from harness.report.surface import Surface, in_order_of_appearance

_COMPRESSION = "PLT_HDR_COMPRESSION"
_TAGS = {tag.name: number for number, tag in xplt.TAG_LUT.items()}
_SURFACES, _DOMAINS = "meshes/0/surfaces/", "meshes/0/domains/"


@dataclass(frozen=True)
class State:
    """Results at one time."""

    time: float  # s
    nodal: dict[str, Array]  # per variable an array of shape (nodes, components)
    # Per variable a list with an array per surface, in the order of `PlotFile.surfaces`; None where FEBio wrote nothing
    # for a surface. Rows are facets, corners of facets, nodes of the surface, or one for the surface.
    on_surfaces: dict[str, list[Array | None]]
    # Per variable an array of shape (nodes, components) where FEBio wrote values at nodes of domains; NaN elsewhere.
    in_domains: dict[str, Array]


@dataclass(frozen=True, eq=False)
class Domain:
    """Elements of one kind."""

    kind: int  # FEBio's number of the element's shape in a plot file
    elements: Ids  # shape (elements, nodes of each): nodes, counted from 0 in the mesh


@dataclass(frozen=True)
class PlotFile:
    """Mesh and results of a run."""

    nodes: Array  # shape (nodes, 3): reference positions, mm
    surfaces: list[Surface]  # surfaces of the model file, in FEBio's order
    domains: dict[str, Domain]  # by name
    states: list[State]

    def positions(self, state: State) -> Array:
        """Deformed positions [mm], shape (nodes, 3); reference positions where the file has no displacement."""
        moved = state.nodal.get("displacement")
        return self.nodes if moved is None else self.nodes + moved


class _Place(dict[str, Any]):
    """A data set or group with its attributes."""

    def __init__(self) -> None:
        super().__init__()
        self.attrs: dict[str, Any] = {}


class _Memory:
    """Takes what pyfebio's reader writes to an HDF5 file, whose attributes are too short for large surfaces."""

    def __init__(self) -> None:
        self.data: dict[str, NDArray[Any]] = {}
        self.places: dict[str, _Place] = defaultdict(_Place)

    def create_dataset(self, path: str, data: Any, dtype: Any = None) -> None:
        self.data[path.lstrip("/")] = np.asarray(data, dtype=dtype)

    def create_group(self, path: str) -> None:
        self.places[path.lstrip("/")] = _Place()

    def __getitem__(self, path: str) -> _Place:
        return self.places[path.lstrip("/")]

    def under(self, folder: str) -> dict[str, NDArray[Any]]:
        """Data sets of a folder by the rest of their path."""
        return {path[len(folder) :]: data for path, data in self.data.items() if path.startswith(folder)}


def read(path: Path) -> PlotFile:
    """Read a plot file.

    Raises DataFileError: no plot file of FEBio, a compressed one, one without results, or one that pyfebio cannot read.
    """
    memory = _parsed(path)
    table = memory.data["meshes/0/nodes"]
    nodes = np.column_stack([table[axis] for axis in "xyz"]).astype(float)
    surfaces = [Surface.from_faces(name, faces) for name, faces in memory.under(_SURFACES).items()]
    domains = {
        name: Domain(int(memory[_DOMAINS + name].attrs["etype"][0]), elements[:, 1:].astype(np.int64))
        for name, elements in memory.under(_DOMAINS).items()
    }
    numbers = sorted({int(path.split("/")[1]) for path in memory.places if path.startswith("states/")})
    if not numbers:
        raise DataFileError(f"{path}: the plot file holds no results; the run may have ended in its first step")
    states = [_state(memory, number, len(nodes), surfaces, domains) for number in numbers]
    return PlotFile(nodes, surfaces, domains, states)


def _parsed(path: Path) -> _Memory:
    memory = _Memory()
    try:
        buffer = path.read_bytes()
        xplt.check_file_is_febio(buffer)
        _parse_blocks(buffer[4:], memory)
    except OSError as error:
        raise DataFileError(f"{path}: {error.strerror}; run the model with a <plotfile type='febio'> first") from error
    except Exception as fault:
        if memory["/"].attrs.get(_COMPRESSION, np.zeros(1)).any():
            raise DataFileError(
                f"{path}: the file is compressed; set <compression>0</compression> in <plotfile>"
            ) from fault
        raise DataFileError(f"{path}: not a plot file that pyfebio reads ({type(fault).__name__}: {fault})") from fault
    return memory


def _blocks(buffer: bytes) -> Iterator[tuple[str, bytes]]:
    """Names and contents of the blocks that follow each other."""
    start = 0
    while start <= len(buffer) - 8:
        tag, size = xplt.parse_prefix(buffer[start : start + 8])
        yield xplt.TAG_LUT[tag].name, buffer[start + 8 : start + 8 + size]
        start += 8 + size


def _with_names(mesh: bytes) -> bytes:
    """The mesh, where each domain has a name: pyfebio needs one, and FEBio writes none for springs."""
    return b"".join(
        _block(section, _with_names_of_domains(content) if section == "PLT_DOMAIN_SECTION" else content)
        for section, content in _blocks(mesh)
    )


def _with_names_of_domains(section: bytes) -> bytes:
    named = []
    for number, (tag, domain) in enumerate(_blocks(section), start=1):
        parts = dict(_blocks(domain))
        if "PLT_DOM_NAME" not in dict(_blocks(parts["PLT_DOMAIN_HDR"])):
            parts["PLT_DOMAIN_HDR"] += _block("PLT_DOM_NAME", f"domain {number}".encode())
        named.append(_block(tag, b"".join(_block(name, content) for name, content in parts.items())))
    return b"".join(named)


def _block(name: str, content: bytes) -> bytes:
    return struct.pack("<2i", _TAGS[name], len(content)) + content


def _parse_blocks(buffer: bytes, memory: Any) -> None:
    """Read the first mesh and all states.

    Results name a domain by its place among the domains. pyfebio takes the number of its part for that, which domains
    of one material share.
    """
    variables: dict[str, list[xplt.DicItem]] = {}
    names: dict[str, dict[int, str]] = {}
    states = 0
    for block, content in _blocks(buffer):
        if block == "PLT_ROOT":
            parts = dict(_blocks(content))
            xplt.parse_root_header(parts["PLT_HEADER"], memory)
            variables = xplt.parse_dictionary(parts["PLT_DICTIONARY"])
        elif block == "PLT_MESH" and not names:
            names = xplt.parse_mesh(_with_names(content), 0, memory)
            names["domains"] = dict(enumerate(memory.under(_DOMAINS), start=1))
        elif block == "PLT_STATE":
            xplt.parse_state(content, states, variables, names, memory)
            states += 1


def _state(memory: _Memory, number: int, nodes: int, surfaces: list[Surface], domains: dict[str, Domain]) -> State:
    here = f"states/{number}/"
    nodal = {path.split("/")[0]: values.astype(float) for path, values in memory.under(here + "node_data/").items()}
    return State(
        time=float(memory[here.rstrip("/")].attrs["time"][0]),
        nodal={name: values for name, values in nodal.items() if len(values) == nodes},
        on_surfaces=_surface_values(memory.under(here + "surface_data/"), surfaces),
        in_domains=_domain_values(memory.under(here + "element_data/"), domains, nodes),
    )


def _surface_values(data: dict[str, NDArray[Any]], surfaces: list[Surface]) -> dict[str, list[Array | None]]:
    floats = {path: values.astype(float) for path, values in data.items()}
    variables = dict.fromkeys(path.split("/", 1)[0] for path in data)
    return {name: [floats.get(f"{name}/{surface.name}") for surface in surfaces] for name in variables}


def _domain_values(data: dict[str, NDArray[Any]], domains: dict[str, Domain], nodes: int) -> dict[str, Array]:
    found: dict[str, Array] = {}
    for path, each in data.items():
        variable, domain = path.split("/", 1)
        members = in_order_of_appearance(domains[domain].elements.ravel())
        if len(each) != len(members):
            continue
        values = found.setdefault(variable, np.full((nodes, each.shape[1]), np.nan))
        values[members] = each
    return found
