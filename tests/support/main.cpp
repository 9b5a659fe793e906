#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <string_view>

namespace {

// "suite.test:suite.test…" of the tests that the source file declares: ctest runs each file in one process, so that
// its tests create a GL context only once, and runs several files at the same time.
std::string filter_of(std::string_view file) {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  std::string ending("/");
  ending += file;
  std::string filter;
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      if (test.file() == file || std::string_view(test.file()).ends_with(ending))
        filter += suite.name() + std::string(".") + test.name() + ":";
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
    const std::string filter = filter_of(argument.substr(option.size()));
    if (filter.empty()) {
      std::fprintf(stderr, "no test in %s\n", argv[i]);
      return 2;
    }
    testing::GTEST_FLAG(filter) = filter;
  }
  return RUN_ALL_TESTS();
}
