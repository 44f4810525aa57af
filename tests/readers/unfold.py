"""Compact storage of CiA 306 (CompactSubObj and its lists of names and values) written as a section for each entry.

python-canopen knows the number of elements of arrays only: no values, and nothing of records.
"""

from __future__ import annotations

import io
import re
from configparser import RawConfigParser

OF_THE_OBJECT = {"objecttype", "compactsubobj", "subnumber"}


def unfolded(text: str) -> str:
    parser = RawConfigParser(allow_no_value=True, inline_comment_prefixes=(";",))
    parser.optionxform = str  # type: ignore[method-assign,assignment]
    parser.read_string(re.sub(r"(?m)^\[0x(?=[0-9A-Fa-f]{4})", "[", text))  # `odgen fix` writes [1000] for [0x1000], too
    names = {name.lower(): name for name in parser.sections()}

    def listed(name: str) -> dict[str, str]:
        section = names.get(name.lower())
        return dict(parser[section]) if section else {}

    for name in parser.sections():
        if name not in parser:  # a list that is written already
            continue
        keys = {key.lower(): key for key in parser[name]}
        count = int(parser[name][keys["compactsubobj"]], 0) if "compactsubobj" in keys else 0
        if not count or f"{name}sub0".lower() in names:
            continue
        of_object = dict(parser[name])
        entry_names, values = listed(f"{name}Name"), listed(f"{name}Value")
        number = {"DataType": "5", "AccessType": "ro", "DefaultValue": str(count), "PDOMapping": "0"}
        parser[f"{name}sub0"] = {"ParameterName": "NrOfObjects", **number}
        for sub in range(1, count + 1):
            entry = {key: value for key, value in of_object.items() if key.lower() not in OF_THE_OBJECT}
            entry[keys["parametername"]] = entry_names.get(str(sub), f"{of_object[keys['parametername']]}{sub}")
            if str(sub) in values:
                entry["ParameterValue"] = values[str(sub)]
            parser[f"{name}sub{sub:X}"] = entry
        parser.remove_option(name, keys["compactsubobj"])
        for of_list in ("Name", "Value", "Denotation"):
            parser.remove_section(names.get(f"{name}{of_list}".lower(), ""))
    written = io.StringIO()
    parser.write(written, space_around_delimiters=False)
    return written.getvalue()
