"""Reference cases of elastic bodies: their truths, their measures and the scenes that are measured."""
