"""Every scene of this collection, by name."""

from collections.abc import Mapping

from studies.synthetic_scenes.reported import assembled, dynamics, outsides, porous, pressed, rigid, slides, straps
from studies.synthetic_scenes.reported.sketch import Drawn

SCENES: Mapping[str, Drawn] = {
    **straps.SCENES,
    **slides.TUBES,
    **outsides.SCENES,
    **slides.SCENES,
    **rigid.SCENES,
    **dynamics.SCENES,
    **porous.SCENES,
    **pressed.SCENES,
    **porous.CHARGED,
    **assembled.SCENES,
}
