#!/usr/bin/env bash
# Makes an image by assets/farm/image.sh, and renders in it:
#
#   tests/farm/image.sh BUILD     the build folder, with the program
#
# A picture by the image's lavapipe, and one by SwiftShader, a driver that is mounted from outside, must be that of one
# render outside, to the bit. Images and containers are in a folder of the test's own.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
needs mmdebstrap mmdebstrap
needs buildah buildah
mkdir storage pictures
cat >storage.conf <<END
[storage]
driver = "vfs"
graphroot = "$folder/storage"
runroot = "$folder/storage/run"
END
# Without namespaces and mounts of an overlay, it works in a container, too.
export CONTAINERS_STORAGE_CONF=$folder/storage.conf BUILDAH_ISOLATION=chroot
stop() { buildah rm --all >/dev/null || :; }

"$root/assets/farm/image.sh" "$build" hyalite
container=$(buildah from --pull-never hyalite)
[ "$(buildah inspect --format '{{index .OCIv1.Config.Entrypoint 0}}' "$container")" = hyalite ]
drivers=$build/drivers
"$root/tests/drivers/fetch.sh" "$drivers" swiftshader
inside() { buildah run -v "$folder/pictures:/work" -v "$drivers:$drivers:ro" "$container" -- "$@"; }
swiftshader=(env VK_DRIVER_FILES="$drivers/swiftshader.json" LD_LIBRARY_PATH="$drivers/swiftshader/usr/lib/chromium")

scene=(cornell --spp 16 --width 200 --height 120)
render_whole "${scene[@]}"
inside hyalite devices >devices
grep -q llvmpipe devices
inside hyalite render "${scene[@]}" --quiet -o lavapipe.exr
expect_whole pictures/lavapipe.exr
inside "${swiftshader[@]}" hyalite devices >devices
grep -q SwiftShader devices
inside "${swiftshader[@]}" hyalite render "${scene[@]}" --device SwiftShader --quiet -o swiftshader.exr
expect_whole pictures/swiftshader.exr
echo "Image: $(buildah images --format '{{.Size}}' hyalite), the picture of a render outside, by its lavapipe and by SwiftShader"
