// facet_bench: benchmarks side by side with peers, one row a subcommand.
#include <cstdlib>
#include <exception>
#include <iostream>

#include "bench/rows.hpp"

int main(int argc, char** argv) {
  CLI::App app("Facet's benchmarks; peers take part where they were found at build time.");
  app.require_subcommand(1);
  // PoCL's threads stay each on its CPU. Otherwise two of them may find themselves on one, after a
  // peer's threads have run, for as long as a launch takes.
  setenv("POCL_AFFINITY", "1", 0);
  facet::bench::add_reference_row(app);
  facet::bench::add_trace_row(app);
  facet::bench::add_build_row(app);
  facet::bench::add_pictures_row(app);
  facet::bench::add_render_row(app);
  facet::bench::add_exactness_row(app);
  facet::bench::add_growth_row(app);
  facet::bench::add_sort_row(app);
  facet::bench::add_fold_row(app);
  facet::bench::add_move_row(app);
  facet::bench::add_limits_row(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e);
  } catch (const std::exception& e) {
    std::cerr << "facet_bench: " << e.what() << '\n';
    return 1;
  }
}
