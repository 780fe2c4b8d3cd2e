// SPDX-License-Identifier: GPL-3.0-or-later

// Whether a file lies on a disk of this machine.
#pragma once

#include <filesystem>

namespace haff::schema {

// Whether the file, or the folder that it is to be in, is on a file system that several machines
// may share: NFS, Lustre, GPFS, BeeGFS, CephFS, SMB, AFS, PanFS, 9p, OCFS2 or FUSE (sshfs,
// GlusterFS). There SQLite's shared memory holds for one machine alone, and its locks hold as far
// as the file system keeps them.
bool is_on_network(const std::filesystem::path& file);

}  // namespace haff::schema
