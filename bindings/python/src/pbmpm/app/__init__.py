"""The ``pbmpm`` command: scenes, runs, pictures, particle files and accuracy studies."""
