"""What the code does not say of the contact's parameters: unit, effect, cost, and what FEBio's interfaces do."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Note:
    """Of one parameter.

    Attributes
    ----------
    effect : str
        What it means and does.
    cost : str
        What it costs, in time or robustness.
    febio : str
        What it is in FEBio's own interfaces.
    unit : str
        Empty: 0 or 1 for truth values, else none.
    default : str
        Empty: that of the code.
    """

    effect: str
    cost: str = "none"
    febio: str = "same"
    unit: str = ""
    default: str = ""


AUTOMATIC = {"penalty", "pressure_penalty", "concentration_penalty", "search_radius"}
"""Parameters that are chosen by the contact where the model does not give them."""

OLD_MODELS = "Accepted for the sake of old models"
"""The heading of parameters that FEBio Studio does not offer."""

ABOUT = {
    "Effects": "The effects that are exchanged, among those that the materials on both sides allow; "
    "see [the log](../start/first-model.md).",
    "Enforcement": "How exactly overlap and jumps are closed; see [penalties](../how-to/parameters.md#penalties) and "
    "[which enforcement](../how-to/parameters.md#which-enforcement).",
    "Ambient values": "Values of the fluid that wets nodes out of contact; "
    "see [ambient conditions](../how-to/ambient.md).",
    "Surfaces and integration": "Which points see each other, and where (2.5) is integrated.",
    "Solution": "These parameters act on the solver. All but the first switch "
    "[devices](../how-to/devices.md). "
    "They act on the whole model: contacts that give one must give the same value.",
    "Friction": "Acts where `fric_coeff` is not 0; [explanation](../explanation/friction.md) has the law, "
    "[FEBio's parameters](from-febio.md#friction) what differs from FEBio's.",
    "Membrane": "A film between the bodies; what is not given crosses freely. See [membranes](../how-to/membranes.md).",
    OLD_MODELS: "They belong to physics or devices that are not part of this contact. Each is an error or a notice, "
    "as said. FEBio gives every contact two more, hidden parameters, "
    "`penalty_sf` and `max_penalty_sf`. They have no effect "
    "here; a notice says so.",
}
"""A sentence on each group of parameters, by its heading."""

NOTES = {
    "laugon": Note(
        "Enforcement: `PENALTY`, `AUGLAG` or `LAGMULT` (0, 1 or 2). `AUGLAG` drives gaps and jumps to their "
        "tolerances, `LAGMULT` makes the loads unknowns of the solve and leaves neither.",
        "`AUGLAG`: each augmentation costs at least one iteration; `LAGMULT`: one equation per primary node and load",
        "`PENALTY` or `AUGLAG`",
    ),
    "tolerance": Note(
        "`AUGLAG`, `LAGMULT`: relative gap or jump of every field: rms gap or jump over the drop across the adjoining "
        "elements. 0: no such criterion.",
        "smaller: more augmentations",
        "default 0.1, on the change of the multipliers and on jumps that depend on units",
    ),
    "traction_tolerance": Note("The same for the gap alone.", "as `tolerance`", "not there", default="`tolerance`"),
    "solvent_tolerance": Note(
        "The same for the pressure jump alone.", "as `tolerance`", "not there", default="`tolerance`"
    ),
    "solute_tolerance": Note(
        "The same for the jumps of all solutes.", "as `tolerance`", "not there", default="`tolerance`"
    ),
    "effects": Note(
        "`all`, or names with commas between them: `traction`, `solvent`, `solutes`, `solute 1` or the solute's own "
        "name. What is left out does not cross: no flux, no memory, no matrix entries. Traction may be left out only "
        "where every displacement of both surfaces is fixed; there it is never exchanged. Asking for what cannot be is "
        "an error that says why.",
        "none; fewer effects cost less",
        "not there",
    ),
    "gaptol": Note(
        "`AUGLAG`, `LAGMULT`: largest gap or overlap of a node in contact. 0: none.",
        "smaller: more augmentations",
        "same; at integration points",
        "mm",
    ),
    "ptol": Note(
        "`AUGLAG`, `LAGMULT`: largest jump of effective pressure. 0: none.",
        "smaller: more augmentations",
        "same; at integration points",
        "MPa",
    ),
    "ctol": Note(
        "`AUGLAG`, `LAGMULT`: largest jump of effective concentration, each solute. 0: none.",
        "smaller: more augmentations",
        "same; at integration points",
        "mM",
    ),
    "penalty": Note(
        "Penalty of the traction. The overlap is traction/penalty. 0 leaves the whole contact out.",
        "very stiff: more iterations where the edge of contact moves; soft: overlap",
        "default: the value 1",
        "N/mm³, or -",
    ),
    "pressure_penalty": Note(
        "Penalty of the solvent flux, a conductance. The jump of effective pressure is flux/penalty. 0 leaves "
        "the solvent out.",
        "only rounding limits it; small: the contact is a membrane",
        "default: the value 1",
        "mm³/(N s), or -",
    ),
    "concentration_penalty": Note(
        "Penalty of all solute fluxes, a conductance. The jump of effective concentration is flux/penalty. "
        "0 leaves solutes out.",
        "only rounding limits it; small: the contact is a membrane",
        "default: the value 1",
        "mm/s, or -",
    ),
    "auto_penalty": Note(
        "Whether given penalties are factors on the local stiffness and conductance.",
        febio="same; a penalty that is not given is automatic here even with 0",
    ),
    "update_penalty": Note(
        "Whether stiffness and conductance are read again at each time step, with the present convection. They "
        "always are where solutes are exchanged and `concentration_penalty` is not given.",
        "a loop over the facets in each step",
    ),
    "two_pass": Note(
        "Integrate over both surfaces: nodes of either have conditions, and both passes share the load "
        "([what that means](../explanation/nodes.md#one-or-two-passes)).",
        "about twice the cost of the contact; less robust at first touch of curved surfaces",
    ),
    "symmetric_stiffness": Note(
        "Hand out a symmetric tangent, for symmetric solvers.",
        "many more iterations, and no convergence where slopes or penalties are large",
        "default 1",
    ),
    "integration": Note(
        "`gauss`: at Gauss points of the primary facets. `segments`: on the pieces into which the facets of both sides "
        "cut each other, see [which](../how-to/surfaces.md#gauss-points-or-segments) (0 or 1).",
        "`segments`: about three times the contact's own work, more on quadratic facets",
        "Gauss points",
        default="`segments`",
    ),
    "integration_order": Note(
        "Gauss points per direction, 1 to 10. 0: 2 on linear facets, 3 on quadratic ones. With `segments` the order "
        "on each piece; 0: 3 where one of its facets is a tri7, quad8 or quad9, else 2.",
        "the contact's own work grows with its square",
        "not there",
    ),
    "search_tol": Note(
        "How far outside a facet the projection of a Gauss point still counts, in parametric coordinates. No effect "
        "with `segments`, which end where facets end."
    ),
    "search_radius": Note(
        "Largest gap or overlap at which facets see each other. Automatic: a gap of a quarter of the longest edge "
        "of the facet that looks, more where facets tilt; an overlap of half the diagonal of the box around the "
        "smaller surface, with `tension` a gap of that size, too. Nothing is seen through a body whose far side is in "
        "its surface.",
        "a large gap: what lies far ahead enters the averages at the edges of contact",
        "default 1; in `sliding-biphasic-solute` partly a multiple of the model's size",
        "mm",
    ),
    "predictor": Note(
        "Form the first matrix of a step at a state that is predicted from the last steps: of every variable whose "
        "last change was predicted to a third, where no load curve turns. A step may then end with its first "
        "iteration. A predicted state is dropped where an element is inverted or the residual is larger than that of "
        "the plain start. Not available with rigid bodies. See [devices](../how-to/devices.md#the-predictor).",
        "memory for the nodal values of five steps, two evaluations of the residual and a copy of the state in a step",
        "not there",
    ),
    "non_negative_concentrations": Note(
        "Where FEBio's solver clamps negative concentrations to zero, solve that as an inequality: such a "
        "concentration is held at zero until its balance makes it positive. Without effect where nothing is clamped.",
        febio="not there",
    ),
    "line_search_guard": Note(
        "Where FEBio's line search left less than half of the last increment of a solution, take the next increment "
        "as a whole before the solution is accepted; once in a step.",
        "at most one iteration in such a step",
        "not there",
    ),
    "solver_devices": Note(
        "[Devices of the solver](../how-to/devices.md) that may act: `all`, `none`, or names with "
        "commas between them. Where a step fails, none acts in the attempt after it, whatever stands here.",
        "fewer devices: more iterations or a larger matrix",
        "not there",
    ),
    "seg_up": Note(
        "After this many iterations of a step points keep to the facet they see. 0: always search.",
        "less exact where points slide far within a step",
    ),
    "node_reloc": Note(
        "At the start, move primary nodes that overlap the secondary surface onto it, in the undeformed mesh too.",
        "changes the geometry",
    ),
    "minaug": Note("Least number of augmentations.", "at least one iteration each"),
    "maxaug": Note(
        "Largest number of augmentations; then the step is accepted with a warning.",
        febio="same; there without a warning",
    ),
    "free_draining": Note(
        "Whether nodes that are not in contact have the ambient values. 0: they are left to the model, and impermeable "
        "where it says nothing of them.",
        febio="not there: 1 in effect in the types that exchange fluid, 0 in the others",
    ),
    "ambient_pressure": Note("Ambient effective pressure; may have a load curve.", unit="MPa"),
    "ambient_concentration": Note(
        "Ambient effective concentration, per solute; may have a load curve.",
        febio="same, both spellings",
        unit="mM",
    ),
    "hydraulic_conductance": Note(
        "Hydraulic conductance of the film, no penalty: solvent flux per driving pressure. 0 leaves the solvent out. "
        "A load curve may change it.",
        febio="not there",
        unit="mm³/(N s)",
        default="no film",
    ),
    "solute_permeance": Note(
        "Permeance of the film for a solute; needs `reflection`. A load curve may change it.",
        febio="not there",
        unit="mm/s",
        default="no film",
    ),
    "reflection": Note(
        "Reflection coefficient of the film, from 0 to 1: the part of a solute that the flow does not carry along. "
        "Below 1 it needs `hydraulic_conductance`. A load curve may change it.",
        febio="not there",
        unit="-",
        default="no film",
    ),
    "flip_primary": Note("Turn the primary surface inside out."),
    "flip_secondary": Note("Turn the secondary surface inside out."),
    "fric_coeff": Note(
        "Friction coefficient that is measured when the fluid pressure has subsided; a load curve may change it. Not "
        "with `laugon` LAGMULT.",
        febio="same",
    ),
    "contact_frac": Note(
        "Part of the contact that is solid on solid, from 0 to 1: of what the effective pressure exceeds the ambient "
        "one by, the rest bears load without friction. 1: fluid makes no difference. A load curve may change it.",
        febio="same",
    ),
    "tangential_penalty": Note(
        "Factor of the tangential penalty over that of the traction: a larger one leaves less elastic slip. By "
        "default the tangential penalty is 100 times the stiffness where `penalty` is left out, and that of the "
        "traction where `penalty` is given. A load curve may change it.",
        "a larger one: more iterations where sticking and sliding meet",
        febio="not there: the penalty of the traction",
        default="0.1; 1 with a given `penalty`",
    ),
    "offset": Note(
        "Distance of the surfaces, along the normal of the primary one, at which they touch: gaps are measured from "
        "it, in all output, too. Negative: an overlap that is let pass. A load curve may change it.",
        febio="`sliding-elastic` has it",
        unit="mm",
    ),
    "tension": Note(
        "Whether surfaces that face each other within `search_radius` pull as well as push: they never part, whatever "
        "the gap, and slide freely. Fluxes cross there, too.",
        febio="`sliding-elastic` has it",
    ),
    "shell_bottom_primary": Note(
        "The back faces of the shells that the primary surface lies on: a thickness behind their nodes, along the "
        "director. Facets may be listed as either face has them. An error on solid elements.",
        febio="forces act on the front face",
    ),
    "shell_bottom_secondary": Note("The same for the secondary surface.", febio="forces act on the front face"),
    "knmult": Note("No effect, with a notice: the linearisation is complete.", febio="factor on a part of the tangent"),
    "smooth_aug": Note("No effect, with a notice.", febio="smoothed augmentation"),
    "smooth_fls": Note("No effect, with a notice: always averaged around nodes.", febio="smoothed fluid load support"),
    "extrapolation": Note("An error: the former name of `predictor`, which was on by default.", febio="not there"),
}
