"""Write the README's console blocks (```bash) to command-1.sh, command-2.sh, …: what a newcomer would paste."""

import re
import sys
from pathlib import Path

readme, folder = Path(sys.argv[1]), Path(sys.argv[2])
commands = re.findall(r"^```bash\n(.*?)^```$", readme.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
if len(commands) != 2:
    sys.exit(f"{readme}: expected two bash blocks, found {len(commands)}")
for number, command in enumerate(commands, start=1):
    (folder / f"command-{number}.sh").write_text(command, encoding="utf-8")
