#pragma once

namespace penumbra::cli {

// Starts the program again, with the same arguments, so that the C library takes memory in huge pages: a setting that
// it reads before main(). Returns where that is not needed, not possible or not wanted:
// - the kernel gives huge pages to all programs, or to none;
// - the variable GLIBC_TUNABLES is set, to whatever value: so for a program that was started again;
// - the C library is another one than glibc, or its loader was run with the program as an argument.
// To be called first in main(). Why: docs/adr/0037-huge-pages.md.
void start_with_huge_pages(char** arguments);

}  // namespace penumbra::cli
