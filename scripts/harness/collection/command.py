"""The command that writes the collection in models/, or a knee."""

from enum import Enum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from harness.errors import HarnessError
from harness.models.interface import InterfaceType
from harness.models.knee.bearing import Load
from harness.models.knee.tissues import TISSUES, Bodies
from harness.models.knee.whole_knee import Knee
from harness.models.knee.whole_mesh import Size
from harness.paths import MODELS, REPOSITORY, is_checkout

console = Console(highlight=False, soft_wrap=True)
SOURCE = REPOSITORY / "models" if is_checkout() else Path(__file__).with_name("models")
"""Where the files of the collection are; a wheel has them beside this module."""


class Family(str, Enum):
    """Families of models, of which one at a time is written."""

    KNEE = "knee"


class Whose(str, Enum):
    """Whose contact interface a model has."""

    MIXTURE = "mixture"
    FEBIO = "febio"


def models(
    ctx: typer.Context,
    family: Annotated[
        Family | None, typer.Argument(help="Write a model of this family in place of the collection.")
    ] = None,
    size: Annotated[Size, typer.Option(help="Size of the mesh of the knee.")] = Size.SMALL,
    bodies: Annotated[Bodies, typer.Option(help="Material type of the knee's cartilage and menisci.")] = Bodies.ELASTIC,
    load: Annotated[Load, typer.Option(help="Load the knee with 700 N, or with one cycle of gait.")] = Load.STANCE,
    contact: Annotated[
        Whose, typer.Option(help="Use the plugin's contact or FEBio's contact in the knee.")
    ] = Whose.MIXTURE,
    friction: Annotated[float, typer.Option(min=0.0, help="Friction coefficient of all contacts of the knee.")] = 0.0,
    output: Annotated[Path | None, typer.Option(help="Write the knee to this .feb file.")] = None,
    folder: Annotated[Path, typer.Option(help="Write the collection to this folder.")] = MODELS,
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing, and fail if a file of the collection is not up to date.")
    ] = False,
) -> None:
    """Write the .feb files of the collection, or a knee."""
    _refuse_others(ctx, _OF_KNEE if family is None else _OF_COLLECTION)
    if family is None:
        _collection(folder, check)
        return
    if output is None or output.suffix != ".feb":
        raise typer.BadParameter(f"`models {family.value}` needs a file that ends in .feb", param_hint="--output")
    interface = InterfaceType.MIXTURE if contact is Whose.MIXTURE else TISSUES[bodies].theirs
    if friction and interface is InterfaceType.SOLUTE:
        raise typer.BadParameter(f"FEBio's {interface.value} has no friction", param_hint="--friction")
    try:
        made = Knee(interface, size, load, friction, name=output.stem, bodies=bodies).model()
        console.print(str(made.write(output.parent)))
    except OSError as error:
        raise HarnessError(f"{output}: {error.strerror}; --output takes a file") from error


_OF_KNEE, _OF_COLLECTION = ("size", "bodies", "load", "contact", "friction", "output"), ("folder", "check")  # options


def _refuse_others(ctx: typer.Context, others: tuple[str, ...]) -> None:
    """An error for a given option that would mean nothing here."""
    for name in others:
        source = ctx.get_parameter_source(name)
        if source is not None and source.name == "COMMANDLINE":
            belongs = "`models knee`" if others is _OF_KNEE else "`models` alone, which writes the collection"
            raise typer.BadParameter(f"it belongs to {belongs}", param_hint=f"--{name}")


def _collection(folder: Path, check: bool) -> None:
    kept = {path.name: path.read_bytes() for path in sorted(SOURCE.glob("*.feb"))}
    if check:
        places = {name: folder / name for name in kept}
        old = [name for name, place in places.items() if not place.is_file() or place.read_bytes() != kept[name]]
        if old:
            raise HarnessError(f"not those of the collection: {', '.join(old)} in {folder}; `models` writes them again")
        return
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in kept.items():
        (folder / name).write_bytes(content)
        console.print(str(folder / name))
