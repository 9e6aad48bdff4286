"""generate.py SOURCE FOLDER - does what the plugin's classes need of Unreal's header tool: NAME.generated.h in FOLDER for each header of SOURCE that has a UCLASS.

It refuses what the real tool would: a class without GENERATED_BODY, a generated header that is not the last include, a property that holds an object by a plain
pointer, a class whose name lacks its prefix.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

CLASS = re.compile(r"UCLASS\([^\n]*\)\nclass (\w+_API) (\w+) : public (\w+)\n\{\n\t(\w+)", re.MULTILINE)


def generated(header: Path) -> str | None:
    """The text for a header; None where it needs none."""
    text = header.read_text(encoding="utf-8")
    if "UCLASS(" not in text:
        return None
    includes = re.findall(r'#include "([^"]+)"', text)
    if not includes or includes[-1] != f"{header.stem}.generated.h":
        raise SystemExit(f"{header}: {header.stem}.generated.h has to be the last include")
    classes = list(CLASS.finditer(text))
    if len(classes) != len(re.findall(r"^UCLASS\(", text, re.MULTILINE)):
        raise SystemExit(f"{header}: a UCLASS is not followed by a class of the usual form")
    if match := re.search(r"UPROPERTY\([^\n]*\)\n\t[AU]\w+\s*\*", text):
        raise SystemExit(f"{header}: a property holds an object by a plain pointer: {match[0]}")
    identifier = f"FID_{header.stem}"
    lines = ["#undef CURRENT_FILE_ID", f"#define CURRENT_FILE_ID {identifier}"]
    for match in classes:
        _, name, base, first = match.groups()
        if first != "GENERATED_BODY" or name[0] not in "AU":
            raise SystemExit(f"{header}: {name} lacks GENERATED_BODY() or its prefix")
        line = text[: match.start(4)].count("\n") + 1
        lines.append(f"#define {identifier}_{line} public: using Super = {base}; using ThisClass = {name}; private:")
    return "\n".join(lines) + "\n"


def main() -> None:
    source, folder = map(Path, sys.argv[1:])
    folder.mkdir(parents=True, exist_ok=True)
    for header in sorted(source.rglob("*.h")):
        if (text := generated(header)) is not None:
            (folder / f"{header.stem}.generated.h").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
