#pragma once
// One process at a time in a run's folder. The lock is the kernel's, so a kill releases it.

#include <filesystem>

namespace sandglass {

class FolderLock {
public:
  /// Throws InputError when another process holds the folder. File systems without locks are let pass.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  int descriptor_ = -1;
};

} // namespace sandglass
