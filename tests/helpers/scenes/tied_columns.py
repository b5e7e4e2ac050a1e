"""Columns of two bodies that are tied, and of one: drawn, sheared and twisted, with flow and diffusion along them."""

from __future__ import annotations

import re

from studies.models.small import Document, Parts, biphasic, contact, control, curve, elastic, fixed, moved

RAMP = curve(1, (0, 0), (1, 1))
SOLUTE = (
    '<solute sol="1"><diffusivity type="diff-const-iso"><free_diff>0.5</free_diff><diff>0.5</diff></diffusivity>'
    '<solubility type="solub-const"><solub>1</solub></solubility></solute>'
)
SOLUTES = (
    '<Solutes><solute id="1" name="s1"><charge_number>0</charge_number><molar_mass>1</molar_mass>'
    "<density>1</density></solute></Solutes>"
)
MODULES = {"solid": "ux;uy;uz", "biphasic": "ux;uy;uz;p", "solute": "ux;uy;uz;p;c1", "multiphasic": "ux;uy;uz;p;c1"}
"""What nodes have, by FEBio's module."""
HIGHEST = 2.0
EXACTLY = "<min_residual>1e-30</min_residual><dtol>1e-9</dtol><etol>1e-12</etol><ptol>1e-9</ptol><ctol>1e-9</ctol>"
"""Tolerances under which Newton's method leaves rounding alone: FEBio takes a residual of 1e-20 for zero."""


def mixed(name: str, number: int) -> str:
    """A biphasic-solute material."""
    text = biphasic(name, number).replace('type="biphasic"', 'type="biphasic-solute"')
    osmotic = '<osmotic_coefficient type="osm-coef-const"><osmcoef>1</osmcoef></osmotic_coefficient>'
    return text.replace("</material>", f"{osmotic}{SOLUTE}</material>")


def multiphasic(name: str, number: int) -> str:
    """The same as a multiphasic material without fixed charges."""
    text = mixed(name, number).replace('type="biphasic-solute"', 'type="multiphasic"')
    return text.replace("<osmotic", "<fixed_charge_density>0</fixed_charge_density><osmotic", 1)


def material(module: str, name: str, number: int) -> str:
    """The material of a module's bodies."""
    return {"solid": elastic, "biphasic": biphasic, "solute": mixed, "multiphasic": multiphasic}[module](name, number)


def steps(module: str, number: int, size: float, analysis: str = "STATIC") -> str:
    """Equal steps that are solved to rounding."""
    unknown = {"solid": r"<[pc]tol>[^<]*</[pc]tol>", "biphasic": r"<ctol>[^<]*</ctol>"}
    wanted = re.sub(unknown.get(module, "$."), "", EXACTLY)
    return control(module, number, size, analysis=analysis).replace("<max_refs>", f"{wanted}<max_refs>")


def prescribed(kind: str, where: str, value: float, dof: str = "") -> str:
    """A prescribed pressure or concentration that follows the ramp."""
    inner = f'{dof}<value lc="1">{value}</value><relative>0</relative>'
    return f'<bc type="prescribed {kind}" node_set="{where}">{inner}</bc>'


def held(kind: str, where: str, value: float, dof: str = "") -> str:
    """A prescribed pressure or concentration that is constant."""
    return f'<bc type="prescribed {kind}" node_set="{where}">{dof}<value>{value}</value><relative>0</relative></bc>'


def initial(where: str, value: float) -> str:
    """An initial concentration of the solute."""
    return f'<ic type="initial concentration" node_set="{where}"><dof>c1</dof><value>{value}</value></ic>'


def reachable(control_section: str) -> str:
    """The same steps with tolerances of pressure and concentration that the rounding of fluxes leaves."""
    return re.sub(r"<([pc]tol)>1e-9<", r"<\1>1e-6<", control_section)


def column(
    module: str, params: str | None, *, cells: tuple[int, int] = (3, 3), gap: float = 0.0, kind: str = "tied-mixture"
) -> tuple[Document, Parts]:
    """A column of one body, or of two that are tied: drawn, sheared and twisted, with flow and diffusion along it.

    Parameters
    ----------
    module : str
        One of `MODULES`.
    params : str, optional
        Parameters of the tie; None: one body.
    cells : tuple of int
        Facets along an edge of the lower and of the upper body.
    gap : float
        Between the bodies, mm.
    kind : str
        Type of the tie.
    """
    parts = Parts()
    if params is None:
        parts.box("low", (0, 0, 0), (1, 1, HIGHEST), (3, 3, 6), "low")
        parts.node_sets["up-top"] = parts.node_sets.pop("low-top")
    else:
        parts.box("low", (0, 0, 0), (1, 1, 1), (cells[0], cells[0], 3), "low")
        parts.box("up", (0, 0, 1 + gap), (1, 1, HIGHEST + gap), (cells[1], cells[1], 3), "up")
    top = [(n, parts.nodes[n - 1]) for n in parts.node_sets["up-top"]]
    parts.node_sets["left"] = [n for n, x in top if x[0] < 0.5]
    parts.node_sets["right"] = [n for n, x in top if x[0] > 0.5]
    boundary = [fixed("low-bottom", "x", "y", "z"), moved("up-top", "x", 0.05), moved("up-top", "z", 0.1)]
    boundary += [moved("left", "y", -0.05), moved("right", "y", 0.05)]
    if module != "solid":
        boundary += [prescribed("fluid pressure", "low-bottom", 0.2), prescribed("fluid pressure", "up-top", 0.0)]
    if module in ("solute", "multiphasic"):
        boundary.append(prescribed("concentration", "low-bottom", 1.0, "<dof>c1</dof>"))
        boundary.append(prescribed("concentration", "up-top", 0.2, "<dof>c1</dof>"))
    document = Document(
        parts.mesh({"pair": ("up-bottom", "low-top")} if params is not None else {}),
        tuple(material(module, part.material, n) for n, part in enumerate(parts.parts, 1)),
        module=module,
        control=steps(module, 2, 0.5, "STATIC" if module == "solid" else "TRANSIENT"),
        boundary=boundary,
        contacts=() if params is None else (contact("tie", "pair", kind, params),),
        curves=(RAMP,),
        node_data=MODULES[module],
        globals=SOLUTES if module in ("solute", "multiphasic") else "",
    )
    return document, parts
