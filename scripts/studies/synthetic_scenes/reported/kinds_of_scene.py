"""Every scene of this collection, by name."""

from collections.abc import Mapping

from studies.synthetic_scenes.reported import (
    assembled,
    charged,
    dynamics,
    outsides,
    porous,
    pressed,
    rigid,
    slides,
    straps,
    tubes,
)
from studies.synthetic_scenes.reported.sketch import Drawn

SCENES: Mapping[str, Drawn] = {
    **straps.SCENES,
    **tubes.SCENES,
    **outsides.SCENES,
    **slides.SCENES,
    **rigid.SCENES,
    **dynamics.SCENES,
    **porous.SCENES,
    **pressed.SCENES,
    **charged.SCENES,
    **assembled.SCENES,
}
