"""Entry point of ``python -m studies``."""

from studies.cli import main

main()
