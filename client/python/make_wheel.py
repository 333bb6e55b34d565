"""make_wheel.py MODULE VERSION FOLDER: packs the built module (the folder that holds seam/) as a wheel.

The wheel is of this Python and this machine's kind; the libraries of Debian that the module is linked with are not in
it. PEP 427 has the format.
"""

import base64
import hashlib
import pathlib
import sys
import sysconfig
import zipfile

WHEN = (1980, 1, 1, 0, 0, 0)  # equal builds give equal wheels


def metadata(version: str) -> str:
    return f"""Metadata-Version: 2.1
Name: seam2d
Version: {version}
Summary: Reads logs of Seam2D as NumPy arrays, steps scenes, runs sessions, joins servers
Requires-Python: =={sys.version_info[0]}.{sys.version_info[1]}.*
Requires-Dist: numpy
"""


def main() -> int:
    module, version, folder = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    tag = f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    files = {str(path.relative_to(module)): path.read_bytes()
             for path in sorted((module / "seam").iterdir()) if path.is_file()}
    if "seam/_seam.so" not in files:
        sys.exit(f"make_wheel.py: {module}/seam has no _seam.so: run make python")
    info = f"seam2d-{version}.dist-info"
    files[f"{info}/METADATA"] = metadata(version).encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: seam2d\nRoot-Is-Purelib: false\n"
                              f"Tag: {tag}\n").encode()
    files[f"{info}/LICENSE"] = pathlib.Path("LICENSE").read_bytes()
    record = ""
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(data)}\n"
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    folder.mkdir(parents=True, exist_ok=True)
    wheel = folder / f"seam2d-{version}-{tag}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as pack:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, WHEN)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            pack.writestr(entry, data)
    print(wheel)
    return 0


if __name__ == "__main__":
    sys.exit(main())
