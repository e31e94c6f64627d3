/// squeal: flutter of the steady sliding state of brakes. The method itself is squeal::analyse (src/analysis.cpp).
#include <cstdio>

#include "analysis.hpp"
#include "petsc/options.hpp"
#include "petsc/session.hpp"
#include "report/report.hpp"

int main(int argc, char** argv) {
  const squeal::Session session(argc, argv);
  if (session.helpWanted()) {
    if (session.rank() == 0) std::fputs(squeal::manual().c_str(), stdout);
    return 0;
  }
  try {
    squeal::checkOptions();  // first of all: a mistake in them touches no folder
    squeal::report::Directory directory(session.comm());
    const squeal::Analysis analysis = squeal::analyse(session.comm());
    squeal::report::write(analysis, directory);
    return analysis.converged() ? 0 : 2;  // instability is a result; a friction without steady state is not
  } catch (const squeal::Error& error) {
    if (session.rank() == 0) std::fprintf(stderr, "squeal: error: %s\n", error.what());
    return 1;
  }
}
