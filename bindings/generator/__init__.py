"""Reads the public C headers of pbmpm and writes what other languages need from them.

``model`` describes the API, ``parser`` builds that description from the headers, and each emitter (``cdef``,
``layout``, ``csharp``, ``fuzz``) turns it into text through a function ``emit(api)``. Run it with ``python -m generator``.
"""
