// SPDX-License-Identifier: BSD-2-Clause
// Work in a child process: its end, its memory and its result.
#include "base/system/child.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>

#include "base/system/stream.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/ranks.hpp"

namespace squeal {
namespace {

using test::expectMessage;

TEST(Child, ItsEndIsAnErrorHere) {
  if (test::rankOf() != 0) return;
  const ChildLimits limits{"the work", 1.0, 1e9, "it is too large", "the worker"};
  const auto end = [&](const std::function<void()>& work) {
    return test::errorOf([&] {
      inChild(limits, [&](const Warn&) {
        work();
        return std::vector<char>();
      });
    });
  };
  EXPECT_EQ(end([] {}), "");
  expectMessage(end([] { std::abort(); }), {"the work: ", "crashed", "Aborted"});
  expectMessage(end([] { raise(SIGSEGV); }), {"crashed", "Segmentation fault"});
  expectMessage(end([] { _exit(3); }), {"exited with code 3"});
  expectMessage(end([] { raise(SIGKILL); }), {"was killed"});
  expectMessage(end([] { throw Error("so it is"); }), {"so it is"});
  expectMessage(end([] { throw std::bad_alloc(); }), {"the work: it is too large"});
  expectMessage(end([] {
                  for (std::atomic<int> i = 0;; ++i) continue;
                }),
                {"not finished after 1 s"});
}

TEST(Child, ItsMemoryIsLimitedAndItsResultWhole) {
  if (test::rankOf() != 0) return;
  const auto numbers = [](std::size_t count) {
    return [count](const Warn&) {
      std::vector<double> values(count);
      for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<double>(i);
      Stream stream;
      stream(values);
      return std::move(stream).bytes();
    };
  };
  const ChildLimits limits{"the work", {}, 1e8, "it is too large", "the worker"};
  // 8 MB, many times what a pipe holds
  Stream stream(inChild(limits, numbers(1000000)));
  std::vector<double> values;
  stream(values);
  ASSERT_EQ(values.size(), 1000000u);
  EXPECT_EQ(values[999999], 999999);
#if !defined(__SANITIZE_ADDRESS__)  // which has an end of its own for this
  expectMessage(test::errorOf([&] { inChild(limits, numbers(100000000)); }),
                {"the work", "it is too large"});
#endif
}

}  // namespace
}  // namespace squeal
