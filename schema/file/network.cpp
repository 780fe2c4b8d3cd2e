// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/file/network.hpp"

#include <sys/vfs.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace haff::schema {

bool is_on_network(const std::filesystem::path& file) {
  // Of linux/magic.h, and of the file systems themselves where they are not part of the kernel.
  constexpr std::array<std::uint32_t, 13> shared{
      0x6969,      // NFS
      0x0bd00bd0,  // Lustre
      0x47504653,  // GPFS
      0x19830326,  // BeeGFS
      0x00c36400,  // CephFS
      0x0000517b,  // SMB
      0xff534d42,  // CIFS
      0xfe534d42,  // SMB 2
      0x5346414f,  // AFS
      0xaad7aaea,  // PanFS
      0x01021997,  // 9p
      0x7461636f,  // OCFS2
      0x65735546,  // FUSE: sshfs, GlusterFS and others; which machines share it cannot be told
  };
  struct statfs about {};
  auto folder = file.parent_path();
  if (folder.empty()) folder = ".";
  if (statfs(file.c_str(), &about) != 0 && statfs(folder.c_str(), &about) != 0) return false;
  return std::ranges::find(shared, static_cast<std::uint32_t>(about.f_type)) != shared.end();
}

}  // namespace haff::schema
