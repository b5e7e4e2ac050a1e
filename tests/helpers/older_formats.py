"""Models of format 4.0 written in the formats 3.0 and 2.5, as FEBio's readers of these take them."""

from __future__ import annotations

from collections.abc import Iterator
from copy import deepcopy

from lxml import etree

Element = etree._Element
VERSIONS = ("2.5", "3.0")
DOFS = {"zero fluid pressure": "p", "prescribed fluid pressure": "p", "initial fluid pressure": "p"}
"""Conditions of one unknown alone; the others name theirs."""
TURNED = {"x": "Rx", "y": "Ry", "z": "Rz", "u": "Ru", "v": "Rv", "w": "Rw"}


def older(text: str, version: str) -> str:
    """The same model in an older format."""
    root = etree.fromstring(text.encode("iso-8859-1"))
    root.set("version", version)
    for control in [*root.iter("Control")]:
        _control(control, version)
    for section in root.iter("Boundary"):
        _replace(section, lambda tag: _condition(tag, version))
    for section in root.iter("Initial"):
        _replace(section, lambda tag: _initial(tag, version))
    _rigid(root, version)
    _mesh(root, version)
    if version == "2.5":
        _curves(root)
        _steps(root)
    return etree.tostring(root, encoding="iso-8859-1", xml_declaration=True).decode("iso-8859-1")


def in_instances(text: str, version: str, *placements: str) -> str:
    """A model whose bodies are instances of parts; each body has nodes of its own, one after the other.

    `placements` are XML of how the instances lie, of which the coordinates of the parts know nothing.
    """
    root = etree.fromstring(older(text, "2.5").encode("iso-8859-1"))
    old, new = root.find("Geometry"), _made("Geometry")
    names = {tag.get("id"): tag.get("name") for tag in root.iterfind("Material/material")}
    for number, block in enumerate(old.iterfind("Elements")):
        own = {node.strip() for element in block for node in element.text.split(",")}
        new.append(_part(old, block, own))
        placement = placements[number] if placements else ""
        new.append(_instance(block.get("name"), names[block.get("mat")], placement, version))
    root.replace(old, new)
    for kind, attribute in (("NodeSet", "node_set"), ("Surface", "surface")):
        for tag in old.iterfind(kind):
            pieces = [
                part.get("name")
                for part in new.iterfind("Part")
                if part.find(f"{kind}[@name='{tag.get('name')}']") is not None
            ]
            whole = _made(kind, name=tag.get("name"))
            whole.extend(_named(kind, attribute, f"{piece}.{tag.get('name')}", version) for piece in pieces)
            new.append(whole)
    new.extend(_pair(tag, version) for tag in old.findall("SurfacePair"))
    made = etree.tostring(root, encoding="iso-8859-1", xml_declaration=True).decode("iso-8859-1")
    return made if version == "2.5" else _with_geometry(text, new)


def _part(mesh: Element, block: Element, own: set[str]) -> Element:
    part = _made("Part", name=block.get("name"))
    nodes = _made("Nodes")
    nodes.extend(deepcopy(node) for node in mesh.find("Nodes") if node.get("id") in own)
    elements = deepcopy(block)
    elements.set("name", "body")
    elements.attrib.pop("mat")
    part.extend([nodes, elements])
    for tag in mesh.iterfind("NodeSet"):
        part.extend(_piece(tag, [node for node in tag if node.get("id") in own]))
    for tag in mesh.iterfind("Surface"):
        part.extend(_piece(tag, [facet for facet in tag if facet.text.split(",")[0].strip() in own]))
    return part


def _piece(tag: Element, members: list[Element]) -> Iterator[Element]:
    if members:
        made = _made(tag.tag, name=tag.get("name"))
        made.extend(deepcopy(member) for member in members)
        yield made


def _instance(name: str, material: str, placement: str, version: str) -> Element:
    made = etree.fromstring(f"<Instance part='{name}'>{placement}</Instance>")
    if version == "3.0":
        made[:] = [etree.fromstring(f"<transform>{placement}</transform>")] if placement else []
    made.append(_made("Elements" if version == "2.5" else "domain", name="body", mat=material))
    return made


def _named(kind: str, attribute: str, name: str, version: str) -> Element:
    return _made(kind, **{attribute: name}) if version == "2.5" else _made(attribute, name)


def _pair(tag: Element, version: str) -> Element:
    if version == "3.0":
        for side, name in zip(tag, ("secondary", "primary"), strict=True):
            side.tag, side.text = name, side.attrib.pop("surface")
    return tag


def _with_geometry(text: str, geometry: Element) -> str:
    root = etree.fromstring(older(text, "3.0").encode("iso-8859-1"))
    root.replace(root.find("Mesh"), geometry)
    root.remove(root.find("MeshDomains"))
    return etree.tostring(root, encoding="iso-8859-1", xml_declaration=True).decode("iso-8859-1")


def _made(tag: str, text: str | None = None, **attributes: str) -> Element:
    made = etree.Element(tag, attributes)
    made.text, made.tail = text, "\n"
    return made


def _replace(section: Element, made_of) -> None:
    section[:] = [new for old in section for new in made_of(old)]


def _control(control: Element, version: str) -> None:
    solver = control.find("solver")
    for method in solver.findall("qn_method") if solver is not None else ():
        solver.remove(method)
        solver.append(_made("max_ups", method.findtext("max_ups", "0")))
        solver.append(_made("qnmethod", method.get("type", "BFGS").upper()))
    if version == "3.0":
        if solver is not None:
            solver.attrib.pop("type", None)
        return
    analysis = control.find("analysis")
    if analysis is not None:
        analysis.set("type", analysis.text.strip().lower().replace("_", "-"))
        analysis.text = None
    if solver is not None:
        control.remove(solver)
        control.extend(solver)


def _dofs(tag: Element) -> tuple[str, list[str]]:
    """Kind of a condition in the older formats, and the unknowns that it is of; none where it keeps its type."""
    kind = tag.get("type", "")
    on = [child.tag.removesuffix("_dof") for child in tag if child.tag.endswith("_dof") and child.text in ("1", "true")]
    named = [name for child in tag.iterfind("*") if child.tag in ("dof", "c_dof") for name in child.text.split(",")]
    if kind.startswith(("zero", "prescribed", "initial")):
        return kind.split()[0], [DOFS[kind]] if kind in DOFS else named or on
    return "", []


def _condition(tag: Element, version: str) -> Iterator[Element]:
    kind, dofs = _dofs(tag)
    where = {"node_set": tag.get("node_set", "")}
    if kind == "zero" and dofs:
        made = _made("fix", bc=",".join(dofs), **where) if version == "2.5" else _made("bc", type="fix", **where)
        if version == "3.0":
            made.append(_made("dofs", ",".join(dofs)))
        yield made
    elif kind == "prescribed" and dofs:
        made = _made("prescribe", bc=dofs[0], **where) if version == "2.5" else _made("bc", type="prescribe", **where)
        if version == "3.0":
            made.append(_made("dof", dofs[0]))
        value = tag.find("value")
        made.append(_made("scale", value.text, **dict(value.attrib)))
        made.extend(tag.findall("relative"))
        yield made
    elif kind not in ("zero", "prescribed"):
        yield tag


def _initial(tag: Element, version: str) -> Iterator[Element]:
    kind, dofs = _dofs(tag)
    if kind != "initial":
        yield tag
        return
    where = {"node_set": tag.get("node_set", "")}
    made = _made("init", bc=dofs[0], **where) if version == "2.5" else _made("ic", type="init_dof", **where)
    if version == "3.0":
        made.append(_made("dof", dofs[0]))
    made.append(tag.find("value"))
    yield made


def _rigid(root: Element, version: str) -> None:
    numbers = {tag.get("name"): tag.get("id") for tag in root.iterfind("Material/material")}
    for section in [*root.iter("Rigid")]:
        if version == "3.0":
            for tag in section.iterfind("rigid_bc"):
                _rigid_3(tag, numbers)
            continue
        bodies = [_rigid_25(tag, numbers) for tag in section.iterfind("rigid_bc")]
        boundary = section.getparent().find("Boundary")
        (boundary if boundary is not None else etree.SubElement(section.getparent(), "Boundary")).extend(bodies)
        section.getparent().remove(section)


def _fixed(tag: Element) -> list[str]:
    return [child.tag.removesuffix("_dof") for child in tag if child.tag.endswith("_dof") and child.text == "1"]


def _rigid_3(tag: Element, numbers: dict) -> None:
    fixed = _fixed(tag)
    tag.tag = "rigid_constraint"
    tag.find("rb").text = numbers[tag.findtext("rb")]
    if tag.get("type") == "rigid_fixed":
        tag.set("type", "fix")
        tag[:] = [tag.find("rb"), _made("dofs", ",".join(fixed))]
    else:
        tag.set("type", "prescribe")
        tag.find("dof").text = TURNED[tag.findtext("dof")]


def _rigid_25(tag: Element, numbers: dict) -> Element:
    body = _made("rigid_body", mat=numbers[tag.findtext("rb")])
    old = {"Rx": "x", "Ry": "y", "Rz": "z", "Ru": "Rx", "Rv": "Ry", "Rw": "Rz"}
    if tag.get("type") == "rigid_fixed":
        body.extend(_made("fixed", bc=old[dof]) for dof in _fixed(tag))
    else:
        value = tag.find("value")
        body.append(_made("prescribed", value.text, bc=old[TURNED[tag.findtext("dof")]], lc=value.get("lc")))
    return body


def _mesh(root: Element, version: str) -> None:
    mesh = root.find("Mesh")
    for tag in mesh.iterfind("NodeSet"):
        tag[:] = [_made("node" if version == "2.5" else "n", id=number.strip()) for number in tag.text.split(",")]
        tag.text = None
    for tag in mesh.iterfind("ElementSet"):
        tag[:] = [_made("elem", id=number.strip()) for number in tag.text.split(",")]
        tag.text = None
    domains = root.find("MeshDomains")
    _shells(root, domains, version)
    if version == "3.0":
        return
    mesh.tag = "Geometry"
    numbers = {tag.get("name"): tag.get("id") for tag in root.iterfind("Material/material")}
    for domain in domains:
        mesh.find(f"Elements[@name='{domain.get('name')}']").set("mat", numbers[domain.get("mat")])
    root.remove(domains)
    for pair in mesh.iterfind("SurfacePair"):
        pair[:] = [
            _made("master", surface=pair.findtext("secondary")),
            _made("slave", surface=pair.findtext("primary")),
        ]


def _shells(root: Element, domains: Element, version: str) -> None:
    """The thickness of shells, which are of four nodes here."""
    for domain in domains.iterfind("ShellDomain[shell_thickness]"):
        thickness = domain.find("shell_thickness")
        domain.remove(thickness)
        data = _made("ElementData", elem_set=domain.get("name"), var="shell thickness")
        count = len(root.find(f"Mesh/Elements[@name='{domain.get('name')}']"))
        tag = "elem" if version == "2.5" else "e"
        data.extend(_made(tag, ",".join([thickness.text] * 4), lid=str(number)) for number in range(1, count + 1))
        section = _made("MeshData")
        section.append(data)
        domains.addnext(section)


def _curves(root: Element) -> None:
    for curve in root.iterfind("LoadData/load_controller"):
        curve.tag = "loadcurve"
        curve.set("type", curve.findtext("interpolate", "linear").lower())
        points = curve.find("points")
        curve[:] = list(points)


def _steps(root: Element) -> None:
    for section in root.findall("Step"):
        place = root.index(section)
        for step in section:
            step.tag = "Step"
        root[place : place + 1] = list(section)
