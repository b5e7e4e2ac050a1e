"""Materials, conditions and parameters of contacts in few words: FEBio's XML. Numbers are in mm, N, s, MPa."""

Material = tuple[str, str]


def neo(modulus: float = 1.0, ratio: float = 0.3, density: float = 1e-9) -> Material:
    """Neo-Hookean, t/mm^3."""
    return "neo-Hookean", f"<density>{density:g}</density><E>{modulus:g}</E><v>{ratio:g}</v>"


def mooney(c1: float = 0.2, c2: float = 0.05, bulk: float = 50.0) -> Material:
    """Mooney-Rivlin."""
    return "Mooney-Rivlin", f"<density>1e-09</density><c1>{c1:g}</c1><c2>{c2:g}</c2><k>{bulk:g}</k>"


def ogden(c1: float = 0.3, m1: float = 4.0, bulk: float = 50.0) -> Material:
    """Ogden, one term."""
    return "Ogden", f"<density>1e-9</density><k>{bulk:g}</k><c1>{c1:g}</c1><m1>{m1:g}</m1>"


def rigid(centre: tuple[float, float, float] = (0.0, 0.0, 0.0), density: float = 1e-9) -> Material:
    """A rigid body and its centre of mass."""
    place = ",".join(f"{x:g}" for x in centre)
    return "rigid body", f"<density>{density:g}</density><center_of_mass>{place}</center_of_mass>"


def biphasic(modulus: float = 1.0, ratio: float = 0.1, permeability: float = 1e-2) -> Material:
    """A porous body with a fifth of solid."""
    return "biphasic", f"<phi0>0.2</phi0>{_porous(modulus, ratio, permeability)}"


def with_solute(modulus: float = 1.0, ratio: float = 0.1, permeability: float = 1e-2) -> Material:
    """The same with one neutral solute."""
    solute = (
        '<osmotic_coefficient type="osm-coef-const"><osmcoef>1</osmcoef></osmotic_coefficient><solute sol="1">'
        '<diffusivity type="diff-const-iso"><free_diff>1e-2</free_diff><diff>5e-3</diff></diffusivity>'
        '<solubility type="solub-const"><solub>1</solub></solubility></solute>'
    )
    return "biphasic-solute", f"<phi0>0.2</phi0>{_porous(modulus, ratio, permeability)}{solute}"


SOLUTE = (
    '<Solutes><solute id="1" name="s1"><charge_number>0</charge_number><molar_mass>1</molar_mass>'
    "<density>1</density></solute></Solutes>"
)
"""The list of solutes."""


def _porous(modulus: float, ratio: float, permeability: float) -> str:
    return (
        f'<fluid_density>1e-9</fluid_density><solid type="neo-Hookean"><density>1e-9</density><E>{modulus:g}</E>'
        f"<v>{ratio:g}</v></solid>"
        f'<permeability type="perm-const-iso"><perm>{permeability:g}</perm></permeability>'
    )


def hold(body: str, dofs: str = "xyzuvw") -> str:
    """A rigid body without these translations and rotations."""
    inner = "".join(f"<R{dof}_dof>{int(dof in dofs)}</R{dof}_dof>" for dof in "xyzuvw")
    return f'<rigid_bc type="rigid_fixed"><rb>{body}</rb>{inner}</rigid_bc>'


def shift(body: str, dof: str, value: float, curve: int = 1) -> str:
    """A rigid body is moved, mm."""
    inner = f'<dof>{dof}</dof><value lc="{curve}">{value:g}</value><relative>0</relative>'
    return f'<rigid_bc type="rigid_displacement"><rb>{body}</rb>{inner}</rigid_bc>'


def spin(body: str, dof: str, value: float, curve: int = 1) -> str:
    """A rigid body is turned about its centre of mass, rad; `dof` is Ru, Rv or Rw."""
    inner = f'<dof>{dof}</dof><value lc="{curve}">{value:g}</value><relative>0</relative>'
    return f'<rigid_bc type="rigid_rotation"><rb>{body}</rb>{inner}</rigid_bc>'


def push(body: str, dof: str, value: float, curve: int = 1) -> str:
    """A force on a rigid body, N."""
    inner = f'<dof>R{dof}</dof><value lc="{curve}">{value:g}</value><load_type>0</load_type>'
    return f'<rigid_load type="rigid_force"><rb>{body}</rb>{inner}</rigid_load>'


def press(surface: str, value: float, curve: int = 1) -> str:
    """A pressure on a surface, MPa."""
    inner = f'<pressure lc="{curve}">{value:g}</pressure><linear>0</linear><symmetric_stiffness>0</symmetric_stiffness>'
    return f'<surface_load type="pressure" surface="{surface}">{inner}</surface_load>'


def drained(nodes: str) -> str:
    """No fluid pressure."""
    return f'<bc type="zero fluid pressure" node_set="{nodes}"/>'


def concentration(nodes: str, value: float) -> str:
    """A concentration is held, mM."""
    inner = f"<dof>c1</dof><value>{value:g}</value><relative>0</relative>"
    return f'<bc type="prescribed concentration" node_set="{nodes}">{inner}</bc>'


def initial_concentration(nodes: str, value: float) -> str:
    """A concentration at the start, mM."""
    return f'<ic type="initial concentration" node_set="{nodes}"><dof>c1</dof><value>{value:g}</value></ic>'


def thrown(nodes: str, velocity: tuple[float, float, float]) -> str:
    """A velocity at the start, mm/s."""
    value = ",".join(f"{x:g}" for x in velocity)
    return f'<ic type="velocity" node_set="{nodes}"><value>{value}</value></ic>'


def auto(factor: float = 1.0, further: str = "") -> str:
    """Penalties by FEBio's measure times a factor."""
    return f"<laugon>PENALTY</laugon><auto_penalty>1</auto_penalty><penalty>{factor:g}</penalty>{further}"


def given(value: float, further: str = "") -> str:
    """A penalty in numbers."""
    return f"<laugon>PENALTY</laugon><auto_penalty>0</auto_penalty><penalty>{value:g}</penalty>{further}"


def auglag(factor: float = 1.0, tolerance: float = 0.1, further: str = "") -> str:
    """Augmentations on penalties by FEBio's measure."""
    return (
        f"<laugon>AUGLAG</laugon><tolerance>{tolerance:g}</tolerance><auto_penalty>1</auto_penalty>"
        f"<penalty>{factor:g}</penalty>{further}"
    )


TWO_PASS = "<two_pass>1</two_pass>"


def radius(value: float) -> str:
    """A search radius, mm."""
    return f"<search_radius>{value:g}</search_radius>"


def friction(coefficient: float) -> str:
    """A friction coefficient."""
    return f"<fric_coeff>{coefficient:g}</fric_coeff>"


def fluid(factor: float, solute: float = 0.0) -> str:
    """Penalties of the pressure and of concentrations."""
    found = f"<pressure_penalty>{factor:g}</pressure_penalty>"
    return found + (f"<concentration_penalty>{solute:g}</concentration_penalty>" if solute else "")
