"""The files in models/, which a wheel has beside this module."""

from pathlib import Path

from harness.paths import REPOSITORY, is_checkout

SOURCE = REPOSITORY / "models" if is_checkout() else Path(__file__).with_name("models")
"""Where the files of the collection are."""


def files() -> dict[str, bytes]:
    """Contents of the files by their names."""
    return {path.name: path.read_bytes() for path in sorted(SOURCE.glob("*.feb"))}


def write(folder: Path) -> list[Path]:
    """Write the collection into `folder`, which is made where needed, and return the paths."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in files().items():
        (folder / name).write_bytes(content)
    return [folder / name for name in files()]


def outdated(folder: Path) -> list[str]:
    """Names of the files in `folder` that are missing or differ from those of the collection."""
    return [
        name
        for name, content in files().items()
        if not (folder / name).is_file() or (folder / name).read_bytes() != content
    ]
