"""What can go wrong, as exceptions whose text is meant for the person at the terminal."""


class HarnessError(Exception):
    """Base of every error that the harness reports without a traceback."""


class EngineNotFoundError(HarnessError):
    """No febio4 executable could be found."""


class PluginNotFoundError(HarnessError):
    """The plugin library that a model needs does not exist."""


class EngineFailedError(HarnessError):
    """febio4 ran and did not end normally; the text quotes what it said."""


class ModelError(HarnessError):
    """A model was described, or a model file was written, in a way that cannot be used."""


class DataFileError(HarnessError):
    """A file written by febio4 does not have the expected form."""
