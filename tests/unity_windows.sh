#!/bin/sh
# unity_windows.sh [FRAMES] - what tests/unity.sh compiled, with pbmpm.dll under Wine: the package's tests, and FRAMES (1000) frames. The run time is that
# of .NET Core for Windows, which a Python package brings. Needs build/unity/bin (tests/unity.sh), the DLL in build/windows-x64 (packaging/library.sh), and wine64.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
frames=${1:-1000}
wine=$(command -v wine64 || ls /usr/lib/wine/wine64 2>/dev/null) || stop "as an administrator type: apt-get install wine64"
[ -e build/unity/bin/Frames.exe ] || stop "there is no build/unity/bin: sh tests/unity.sh"
dll=build/windows-x64/lib/pbmpm.dll
[ -e "$dll" ] || stop "there is no $dll: sh packaging/library.sh windows-x64"

work=$PWD/build/unity-windows
run_time=$work/dotnet/dotnetcore2/bin/dotnet.exe
if [ ! -e "$run_time" ]; then
    stage "A run time for Windows"
    quietly unity-dotnet.log python3 -m pip --disable-pip-version-check install --no-deps --only-binary :all: --platform win_amd64 --target "$work/dotnet" \
        dotnetcore2 || stop "could not fetch it; full text: build/unity-dotnet.log"
fi
cp build/unity/bin/*.exe build/unity/bin/*.dll "$dll" "$work"
export WINEDEBUG=-all WINEPREFIX="$work/wine" DOTNET_SYSTEM_GLOBALIZATION_INVARIANT=1 # no library of texts for all languages
play() {
    program=$1
    shift
    echo '{"runtimeOptions": {"framework": {"name": "Microsoft.NETCore.App", "version": "3.1.0"}}}' >"$work/${program%.exe}.runtimeconfig.json"
    (cd "$work" && "$wine" "$run_time" "$program" "$@")
}
stage "Under Wine"
play RunTests.exe
play Frames.exe "$frames"
play Frames.exe "$frames" background
