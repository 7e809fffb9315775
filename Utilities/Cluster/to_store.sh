#!/usr/bin/env bash
# A finished dataset into an object store, or wherever rclone leads: the manifest goes last, so that a dataset with a manifest is whole.
#
#   Utilities/Cluster/to_store.sh dataset remote:bucket/dataset
set -eu
rclone copy --checksum --exclude manifest.json "$1" "$2"
rclone copy --checksum --include manifest.json "$1" "$2"
