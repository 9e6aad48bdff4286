"""The one exception the command turns into exit code 2."""


class InputError(Exception):
    """A file, option or value that the user gave cannot be used; the message says which and why."""
