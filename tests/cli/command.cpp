// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/command.h"
#include "tests/source_dir.h"

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <doctest/doctest.h>

namespace mms::cli {

namespace fs = std::filesystem;

namespace {

std::string slurp(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

int exit_code(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

std::string project_text(const std::string& path) {
  return slurp(mms::source_dir().string() + "/" + path);
}

Folder::Folder() {
  std::string name = (fs::temp_directory_path() / "mms-cli-XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  root_ = name;
  fs::create_directory(root_ + ".logs");
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(root_, ignored);
  fs::remove_all(root_ + ".logs", ignored);
}

void Folder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

bool Folder::has(const std::string& name) const { return fs::exists(path(name)); }

std::string Folder::read(const std::string& name) const { return slurp(path(name)); }

int Folder::file_count() const {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : fs::recursive_directory_iterator(root_)) ++count;
  return count;
}

Outcome Folder::mms(const std::string& args, const std::string& input) const {
  const std::string logs = root_ + ".logs";
  std::ofstream(logs + "/in", std::ios::binary) << input;
  const std::string line = "cd '" + root_ + "' && '" MMS_COMMAND "' " + args + " <'" + logs +
                           "/in' >'" + logs + "/out' 2>'" + logs + "/err'";
  Outcome outcome;
  outcome.exit = exit_code(std::system(line.c_str()));
  outcome.out = slurp(logs + "/out");
  outcome.err = slurp(logs + "/err");
  return outcome;
}

Outcome Folder::bash(const std::string& script) const {
  const std::string logs = root_ + ".logs";
  std::ofstream(logs + "/script", std::ios::binary) << script;
  const std::string folder = fs::path(MMS_COMMAND).parent_path().string();
  const std::string line = "cd '" + root_ + "' && PATH='" + folder + "':\"$PATH\" bash '" + logs +
                           "/script' </dev/null >'" + logs + "/out' 2>'" + logs + "/err'";
  Outcome outcome;
  outcome.exit = exit_code(std::system(line.c_str()));
  outcome.out = slurp(logs + "/out");
  outcome.err = slurp(logs + "/err");
  return outcome;
}

Outcome Folder::killed_on_terminal(const std::string& args, int lines, int microseconds) const {
  const std::string line = "cd '" + root_ + "' && exec '" MMS_COMMAND "' " + args;
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  REQUIRE(child >= 0);
  if (child == 0) {
    execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  Outcome outcome;
  const auto read_some = [&] {
    char bytes[4096];
    const ssize_t n = ::read(terminal, bytes, sizeof bytes);
    if (n > 0) outcome.out.append(bytes, std::size_t(n));
    return n > 0;  // the terminal of a process that has ended has an error behind its last byte
  };
  while (std::count(outcome.out.begin(), outcome.out.end(), '\r') < lines && read_some()) continue;
  usleep(useconds_t(microseconds));
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  while (read_some()) continue;
  close(terminal);
  outcome.exit = exit_code(status);
  return outcome;
}

Outcome Folder::interrupted_render(const std::string& args, const std::string& script) const {
  const std::string logs = root_ + ".logs";
  const std::string line = "cd '" + root_ + "' && exec '" MMS_COMMAND "' render - " + args + " >'" +
                           logs + "/out' 2>'" + logs + "/err'";
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
    close(ends[1]);
    execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(ends[0]);
  // More than any pipe holds: when all is written, the command is reading, so it has set its
  // handler. No clock is needed.
  const std::string text = script + "\n//" + std::string(std::size_t(4) << 20, ' ') + "\n";
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(ends[1], text.data() + done, text.size() - done);
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  kill(child, SIGINT);
  close(ends[1]);
  int status = 0;
  waitpid(child, &status, 0);
  return {exit_code(status), slurp(logs + "/out"), slurp(logs + "/err")};
}

}  // namespace mms::cli
