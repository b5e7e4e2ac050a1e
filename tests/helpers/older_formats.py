"""Models of format 4.0 written in the formats 3.0 and 2.5, as FEBio's readers of these take them."""

from __future__ import annotations

from collections.abc import Iterator

from lxml import etree

Element = etree._Element
VERSIONS = ("2.5", "3.0")
DOFS = {"zero fluid pressure": "p", "prescribed fluid pressure": "p", "initial fluid pressure": "p"}
"""Conditions of one unknown alone; the others name theirs."""
STEP = ("time_steps", "step_size", "plot_level", "time_stepper", "output_level", "plot_stride")
"""Children of <Control> that stay where they are."""
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
