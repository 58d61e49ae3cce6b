// SPDX-License-Identifier: Apache-2.0
// The verbs over pictures, handed on to `mms-render` beside this program: the same command with the
// renderer linked in. Loading Embree and OpenImageIO takes far longer than checking a script, so
// the verbs that draw nothing do without them.
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tools/compare.h"
#include "tools/converge.h"
#include "tools/merge.h"
#include "tools/render.h"

namespace mms::tools {

namespace {

Exit start_renderer(const ScriptOptions& options) {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string line{std::istreambuf_iterator<char>(file), {}};
  std::vector<char*> arguments;
  for (std::size_t at = 0; at < line.size(); at = line.find('\0', at) + 1)
    arguments.push_back(line.data() + at);
  arguments.push_back(nullptr);
  std::error_code error;
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe", error).replace_filename("mms-render");
  execv(program.c_str(), arguments.data());
  return fail(Exit::File,
              {program.string(), std::string("cannot be started: ") + std::strerror(errno),
               "it is built and installed beside mms: build again, or install both"},
              options);
}

}  // namespace

Exit render_pictures(const RenderRequest& request) { return start_renderer(request); }
Exit merge_films(const MergeRequest& request) { return start_renderer(request); }
Exit compare_pictures(const CompareRequest& request) { return start_renderer(request); }
Exit measure_convergence(const ConvergeRequest& request) { return start_renderer(request); }

}  // namespace mms::tools
