"""Makes the page of a run from its model file, its log and its plot file."""

from pathlib import Path

import numpy as np

from harness.errors import DataFileError
from harness.preflight.formats import read_newest
from harness.preflight.xml_file import Document
from harness.report import history, pictures, plot_file, vtk_files
from harness.report.history import Contact
from harness.report.page import Page, Picture, Table
from harness.run import febio_log, provenance

_WANTED = (history.PRESSURE, history.FORCE, "displacement")
_WANTED_OF_FLUID = (history.FLUID[1], history.SOLVENT_FLOW, history.SOLUTE_FLOW)


def make(model: Path, folder: Path) -> Page:
    """Draw the pictures of a run into a folder, with the surfaces as VTK files, and gather what its page says.

    Raises DataFileError: no log or plot file beside the model, one that cannot be read, or no contact pressure in it.
    """
    log = _text_of(model.with_suffix(".log"), model)
    document = read_newest(model)
    plot = plot_file.read(model.with_suffix(".xplt"))
    contacts = history.contacts(plot)
    if not contacts:
        raise DataFileError(
            f"{model}: the plot file has no surface with a contact pressure. If the bodies touch, add "
            '<var type="contact pressure"/> to <plotfile> and run the model again'
        )
    shown = int(np.argmax(np.max([contact.force for contact in contacts], axis=0)))
    time = f"{plot.states[shown].time:.4g} s"
    seen = [
        Picture(file, f"{contact.surface.name} at {time}, the time of the largest force: contact pressure")
        for contact, file in zip(contacts, pictures.draw_pressures(plot, contacts, shown, folder), strict=True)
    ]
    vtk_files.write_surfaces(plot, contacts, shown, folder)
    curves = [Picture(file, file.stem.replace("-", " ")) for file in pictures.draw_curves(contacts, folder)]
    report = febio_log.parse(log)
    return Page(
        title=f"{model.name}: contact",
        summary=_summary(report, log),
        warnings=[*report.errors, *report.warnings],
        surfaces=seen,
        curves=curves,
        tables=[_figures(contacts, shown, time), *_settings(document)],
        notes=_notes(plot),
    )


def _text_of(log: Path, model: Path) -> str:
    try:
        return log.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise DataFileError(f"{log}: {error.strerror}; run {model.name} first, its log is next to it") from error


def _summary(report: febio_log.Report, log: str) -> str:
    end = "ended normally" if report.normal else "did NOT end normally"
    return (
        f"The run {end}: {report.steps} steps, {report.iterations} iterations, {report.retries} retries, "
        f"{report.augmentations} augmentations. {provenance.engine_version(log)}."
    )


def _figures(contacts: list[Contact], shown: int, time: str) -> Table:
    columns = ("surface", "force [N]", "area [mm²]", "largest [MPa]", "mean [MPa]", "fluid bears")
    rows = []
    for contact in contacts:
        share = contact.fluid_share[shown]
        numbers = (contact.force, contact.area, contact.peak, contact.mean)
        known = f"{share:.3f}" if np.isfinite(share) else "not known"
        rows.append((contact.surface.name, *(f"{values[shown]:.4g}" for values in numbers), known))
    return Table(f"At {time}", columns, rows)


def _settings(document: Document) -> list[Table]:
    tables = []
    for _, contact in document.everywhere("Contact", "contact"):
        rows: list[tuple[str, ...]] = [
            (str(child.tag), (child.text or "").strip()) for child in contact if isinstance(child.tag, str)
        ]
        name = contact.get("name") or contact.get("surface_pair") or ""
        tables.append(Table(f"Contact '{name}', {contact.get('type')}", ("parameter", "in the model file"), rows))
    return tables


def _notes(plot: plot_file.PlotFile) -> list[str]:
    last = plot.states[-1]
    there = {*last.on_surfaces, *last.nodal, *last.in_domains}
    missing = [name for name in _WANTED if name not in there]
    if last.in_domains:
        missing += [name for name in _WANTED_OF_FLUID if name not in there]
    if not missing:
        return []
    lines = ", ".join(f'<var type="{name}"/>' for name in missing)
    return [f"The page can show more if <plotfile> of the model contains {lines}."]
