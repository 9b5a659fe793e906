#include <fnmatch.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>

namespace {

// Whether a test's name matches one of the patterns, between which are colons.
bool matches(std::string_view patterns, const std::string& name) {
  while (!patterns.empty()) {
    const std::string pattern(patterns.substr(0, patterns.find(':')));
    if (fnmatch(pattern.c_str(), name.c_str(), FNM_NOESCAPE) == 0) return true;
    patterns.remove_prefix(std::min(pattern.size() + 1, patterns.size()));
  }
  return false;
}

// As GoogleTest understands its filters: patterns, and after a '-' those of tests to leave out.
bool is_chosen(std::string_view filter, const std::string& name) {
  const std::size_t minus = std::min(filter.find('-'), filter.size());
  return (minus == 0 || matches(filter.substr(0, minus), name)) &&
         !matches(filter.substr(std::min(minus + 1, filter.size())), name);
}

// "suite.test:suite.test…" of the tests that the source file declares and `chosen` does not leave out: ctest runs each
// file in one process, so that its tests create a GL context only once, and runs several files at the same time.
std::string filter_of(std::string_view file, std::string_view chosen) {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  std::string ending("/");
  ending += file;
  std::string filter;
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      const std::string name = suite.name() + std::string(".") + test.name();
      const bool is_of_file = test.file() == file || std::string_view(test.file()).ends_with(ending);
      if (is_of_file && is_chosen(chosen, name)) filter += name + ":";
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const std::string_view option = "--file=";
    if (!argument.starts_with(option)) {
      std::fprintf(stderr, "unknown argument: %s\n", argv[i]);
      return 2;
    }
    const std::string filter = filter_of(argument.substr(option.size()), testing::GTEST_FLAG(filter));
    if (filter.empty()) {
      std::fprintf(stderr, "no test in %s\n", argv[i]);
      return 2;
    }
    testing::GTEST_FLAG(filter) = filter;
  }
  const int result = RUN_ALL_TESTS();
  if (!testing::GTEST_FLAG(list_tests) && testing::UnitTest::GetInstance()->test_to_run_count() == 0) {
    std::fprintf(stderr, "no test matches %s\n", testing::GTEST_FLAG(filter).c_str());
    return 2;
  }
  return result;
}
