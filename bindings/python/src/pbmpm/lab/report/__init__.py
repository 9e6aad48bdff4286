"""Reports for people: one page per sweep that opens without a network, and verdicts computed from the rows."""
