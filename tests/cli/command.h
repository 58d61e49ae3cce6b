// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Runs the `mms` command as a user does, in a folder of its own.

#include <string>

namespace mms::cli {

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A file of the project, by its path from the top; empty where there is none.
std::string project_text(const std::string& path);

/// What a run left.
struct Outcome {
  int exit = -1;  ///< exit code; 128 and the signal's number if a signal ended it
  std::string out, err;
};

/// A fresh folder, removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path(const std::string& name) const { return root_ + "/" + name; }
  void write(const std::string& name, const std::string& text) const;
  bool has(const std::string& name) const;
  std::string read(const std::string& name) const;
  int file_count() const;  ///< of everything in it

  /// `mms ARGS` here, by the shell; `input` is its standard input.
  Outcome mms(const std::string& args, const std::string& input = "") const;

  /// A bash script here, in which `mms` is the command.
  Outcome bash(const std::string& script) const;

  /// `mms ARGS` here on a terminal, killed so long after it has shown its progress `lines` times.
  /// What it showed is `out`.
  Outcome killed_on_terminal(const std::string& args, int lines, int microseconds) const;

  /// `mms render - ARGS` here, sent SIGINT once it has begun to read `script`.
  Outcome interrupted_render(const std::string& args, const std::string& script) const;

 private:
  std::string root_;
};

}  // namespace mms::cli
