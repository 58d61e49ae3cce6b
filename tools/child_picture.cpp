// SPDX-License-Identifier: Apache-2.0
#include "tools/child.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include "tools/render_job.h"

namespace mms::tools {

std::optional<Ended> run_child(const std::string& command) {
  std::FILE* pipe = popen(("echo $$; exec " + command).c_str(), "r");
  if (!pipe) return std::nullopt;
  Ended ended;
  char buffer[4096];
  bool told = false;
  pollfd output{fileno(pipe), POLLIN, 0};
  while (true) {
    if (interrupted() && !told && ended.out.find('\n') != ended.out.npos) {
      kill(std::atoi(ended.out.c_str()), SIGTERM);
      told = true;
    }
    constexpr int kGlance = 100;  // milliseconds
    if (poll(&output, 1, kGlance) <= 0) continue;
    const ssize_t n = read(output.fd, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    ended.out.append(buffer, std::size_t(n));
  }
  ended.out.erase(0, ended.out.find('\n') + 1);
  ended.status = pclose(pipe);
  return ended;
}

}  // namespace mms::tools
