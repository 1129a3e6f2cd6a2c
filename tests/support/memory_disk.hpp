/// \file
/// A disk in memory on which everything goes wrong that can: errors at any call, short writes, power cuts.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <string_view>

#include "engine/durable/disk.hpp"

namespace sesame::tests {

class MemoryDisk final : public engine::Disk {
 public:
  /// A file as processes see it, and as it was when it was last synced.
  struct Content {
    std::string now, synced;
    std::size_t untouched = 0;  ///< so many bytes have not changed since then
    bool is_locked = false;
  };

  /// Asked before each call, "append", "read", "sync", "truncate", "size", "open", "rename", "remove" or "sync folder";
  /// what it returns, but 0, is the errno with which the call fails.
  std::function<int(std::string_view call)> fault = [](std::string_view) { return 0; };
  /// Of an append that fails, so much is written, at most.
  std::function<std::size_t(std::size_t size)> short_write = [](std::size_t) { return std::size_t{0}; };

  std::unique_ptr<engine::File> open(const std::string& path, Mode mode, int& error) override {
    error = fault("open");
    const auto found = names_.find(path);
    if (error == 0 && mode == Mode::create && found != names_.end()) {
      error = EEXIST;
    }
    if (error == 0 && mode != Mode::create && found == names_.end()) {
      error = ENOENT;
    }
    if (error != 0) {
      return nullptr;
    }
    if (mode == Mode::create) {
      names_[path] = std::make_shared<Content>();
    }
    return std::make_unique<OpenFile>(*this, names_[path]);
  }
  int rename(const std::string& from, const std::string& to) override {
    if (const int error = fault("rename"); error != 0) {
      return error;
    }
    names_[to] = names_.at(from);
    names_.erase(from);
    return 0;
  }
  int remove(const std::string& path) override {
    if (const int error = fault("remove"); error != 0) {
      return error;
    }
    return names_.erase(path) == 1 ? 0 : ENOENT;
  }
  int sync_folder_of(const std::string& /*path*/) override {
    if (const int error = fault("sync folder"); error != 0) {
      return error;
    }
    synced_names_ = names_;
    return 0;
  }

  [[nodiscard]] std::string& bytes(const std::string& path) { return names_.at(path)->now; }
  [[nodiscard]] bool has(const std::string& path) const { return names_.contains(path); }
  void write(const std::string& path, const std::string& bytes) {
    names_[path] = std::make_shared<Content>(Content{bytes, bytes, bytes.size(), false});
    synced_names_ = names_;
  }

  /// What a power cut leaves: names as they were synced, or as they are; of each file what was synced, and of what came
  /// since then some length, in which sectors that were not written are zeros.
  template <class Random>
  void cut_power(Random& random, std::size_t sector = 16) {
    if (random() % 2 == 0) {
      names_ = synced_names_;
    }
    for (auto& [name, content] : names_) {
      const Content before = *content;
      content = std::make_shared<Content>();  // those that have it open keep what is no more
      std::string& left = content->now;
      const std::size_t sound = std::min({before.untouched, before.now.size(), before.synced.size()});
      if (random() % 4 == 0) {
        left = before.synced;  // nothing since then got there, not even a new size
      } else {
        left = before.now.substr(0, sound + random() % (before.now.size() - sound + 1));
        for (std::size_t at = sound; at < left.size(); at += sector - at % sector) {
          const std::size_t size = std::min(sector - at % sector, left.size() - at);
          if (random() % 3 == 0) {
            std::fill_n(left.begin() + static_cast<std::ptrdiff_t>(at), size, '\0');
          }
        }
      }
      content->synced = left;
      content->untouched = left.size();
    }
    synced_names_ = names_;
  }

 private:
  class OpenFile final : public engine::File {
   public:
    OpenFile(MemoryDisk& disk, std::shared_ptr<Content> content) : disk_{disk}, content_{std::move(content)} {}
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile() override {
      if (has_lock_) {
        content_->is_locked = false;
      }
    }

    engine::Transfer append(std::span<const char> bytes) override {
      const int error = disk_.fault("append");
      const std::size_t size = error == 0 ? bytes.size() : std::min(disk_.short_write(bytes.size()), bytes.size());
      content_->now.append(bytes.data(), size);
      return {size, error};
    }
    engine::Transfer read(std::uint64_t from, std::span<char> to) override {
      if (const int error = disk_.fault("read"); error != 0) {
        return {0, error};
      }
      const std::string& bytes = content_->now;
      const std::size_t begin = std::min<std::size_t>(from, bytes.size());
      const std::size_t count = std::min(to.size(), bytes.size() - begin);
      std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(begin), count, to.begin());
      return {count, 0};
    }
    int sync() override {
      if (const int error = disk_.fault("sync"); error != 0) {
        // What failed once is dropped, and a second fsync would succeed: it syncs only what is written after.
        lost_ = content_->now.size();
        return error;
      }
      if (lost_ > content_->untouched) {
        return 0;  // a lie, as systems tell it
      }
      content_->synced = content_->now;
      content_->untouched = content_->now.size();
      return 0;
    }
    int truncate(std::uint64_t size) override {
      if (const int error = disk_.fault("truncate"); error != 0) {
        return error;
      }
      content_->now.resize(size);
      content_->untouched = std::min<std::size_t>(content_->untouched, size);
      if (size <= content_->untouched) {
        lost_ = 0;  // what is written behind it is new
      } else {
        lost_ = std::min<std::size_t>(lost_, size);
      }
      return 0;
    }
    int rewrite(std::uint64_t from, std::span<const char> bytes) override {
      if (const int error = disk_.fault("rewrite"); error != 0) {
        return error;
      }
      content_->now.replace(from, bytes.size(), bytes.data(), bytes.size());
      if (from <= content_->untouched && from + bytes.size() >= lost_) {
        lost_ = 0;  // it is to be written again
      }
      content_->untouched = std::min<std::size_t>(content_->untouched, from);
      return 0;
    }
    bool is_at(const std::string& path) override { return disk_.names_.at(path) == content_; }
    [[nodiscard]] bool is_readable() const override { return true; }
    int size(std::uint64_t& bytes) override {
      bytes = content_->now.size();
      return disk_.fault("size");
    }
    bool lock() override {
      has_lock_ = !content_->is_locked;
      content_->is_locked = true;
      return has_lock_;
    }
    std::int64_t holder() override { return 42; }

   private:
    MemoryDisk& disk_;
    std::shared_ptr<Content> content_;
    std::size_t lost_ = 0;  ///< bytes before this one were dropped by a sync that failed
    bool has_lock_ = false;
  };

  std::map<std::string, std::shared_ptr<Content>> names_, synced_names_;
};

}  // namespace sesame::tests
