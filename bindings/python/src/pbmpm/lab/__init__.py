"""The ``pbmpm`` command: scenes, runs, pictures, particle files and studies. It needs `pip install pbmpm[lab]`."""
