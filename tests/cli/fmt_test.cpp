// SPDX-License-Identifier: Apache-2.0
// mms fmt: what it writes, and what it leaves alone.
#include <unistd.h>
#include <chrono>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include "tests/cli/command.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;

namespace {

namespace fs = std::filesystem;

constexpr const char* kUntidy = "surface  s\nbsdf=matte(1); // grey\nend";
constexpr const char* kTidy = "surface s\n    bsdf = matte(1);  // grey\nend\n";

}  // namespace

TEST_CASE("fmt writes a script in its place, says nothing, and keeps who may read it") {
  const Folder folder;
  folder.write("s.mms", kUntidy);
  fs::permissions(folder.path("s.mms"), fs::perms::owner_read | fs::perms::owner_write);
  for (int round = 0; round < 2; ++round) {
    const Outcome run = folder.mms("fmt s.mms");
    CHECK(run.exit == 0);
    CHECK(run.out == "");
    CHECK(run.err == "");
    CHECK(folder.read("s.mms") == kTidy);
  }
  CHECK(fs::status(folder.path("s.mms")).permissions() ==
        (fs::perms::owner_read | fs::perms::owner_write));
  CHECK(folder.file_count() == 1);
}

TEST_CASE("fmt of a script that is laid out does not touch the file") {
  const Folder folder;
  folder.write("s.mms", kTidy);
  const auto before = fs::file_time_type() + std::chrono::hours(1);
  fs::last_write_time(folder.path("s.mms"), before);
  CHECK(folder.mms("fmt s.mms").exit == 0);
  CHECK(fs::last_write_time(folder.path("s.mms")) == before);
}

TEST_CASE("fmt from standard input to standard output") {
  const Folder folder;
  const Outcome run = folder.mms("fmt -", kUntidy);
  CHECK(run.exit == 0);
  CHECK(run.out == kTidy);
}

TEST_CASE("fmt --check changes nothing and names each file that is not laid out") {
  const Folder folder;
  folder.write("a.mms", kUntidy);
  folder.write("b.mms", kTidy);
  const Outcome run = folder.mms("fmt --check a.mms b.mms");
  CHECK(run.exit == 1);
  CHECK(contains(run.err, "a.mms: is not laid out"));
  CHECK(contains(run.err, "help: `mms fmt a.mms`"));
  CHECK_FALSE(contains(run.err, "b.mms"));
  CHECK(folder.read("a.mms") == kUntidy);
  CHECK(folder.mms("fmt --check b.mms").exit == 0);
  CHECK(folder.mms("fmt --check -", kUntidy).exit == 1);
}

TEST_CASE("fmt leaves a script with syntax errors alone, and goes on") {
  const Folder folder;
  const std::string bad = "surface  s\n  bsdf = matte(0.5;\nend\n";
  folder.write("bad.mms", bad);
  folder.write("good.mms", kUntidy);
  const Outcome run = folder.mms("fmt bad.mms good.mms");
  CHECK(run.exit == 1);
  CHECK(contains(run.err, "bad.mms:2:"));
  CHECK(folder.read("bad.mms") == bad);
  CHECK(folder.read("good.mms") == kTidy);
}

TEST_CASE("fmt follows a link, and replaces what it leads to") {
  const Folder folder;
  folder.write("real.mms", kUntidy);
  fs::create_symlink("real.mms", folder.path("link.mms"));
  CHECK(folder.mms("fmt link.mms").exit == 0);
  CHECK(fs::is_symlink(folder.path("link.mms")));
  CHECK(folder.read("real.mms") == kTidy);
}

TEST_CASE("fmt of a file that cannot be written says so") {
  if (::geteuid() == 0) return;  // nothing is forbidden to root
  const Folder folder;
  folder.write("s.mms", kUntidy);
  fs::permissions(folder.path("s.mms"), fs::perms::owner_read);
  const Outcome run = folder.mms("fmt s.mms");
  CHECK(run.exit == 3);
  CHECK(contains(run.err, "s.mms: cannot be written"));
  CHECK(contains(run.err, "help: "));
  CHECK(folder.read("s.mms") == kUntidy);
}
