"""The commands of ``pbmpm``, one file each."""
