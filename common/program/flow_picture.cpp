#include "common/program/flow_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/io/options.hpp"
#include "common/program/picture_samples.hpp"

namespace talus::program {
namespace {

// A field that can be drawn in colours.
struct Quantity {
  const char *name, *title, *symbol;
  std::string PictureLabels::*unit;  // none: a number
  bool log_scale;
  io::LogEnd kept;  // what flows is of interest
  double (*value)(const PictureSample&);
};

constexpr const char* regions_name = "regions";
constexpr const char* mesh_name = "mesh";

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all = {
      {"speed", "Speed", "|u|", &PictureLabels::velocity, false, io::LogEnd::high,
       [](const PictureSample& at) { return at.speed; }},
      {"pressure", "Pressure", "p", &PictureLabels::pressure, false, io::LogEnd::high,
       [](const PictureSample& at) { return at.law.total_pressure; }},
      {"shear-rate", "Shear rate", "|γ|", &PictureLabels::rate, true, io::LogEnd::high,
       [](const PictureSample& at) { return at.law.shear_rate; }},
      {"inertial-number", "Inertial number", "I", nullptr, true, io::LogEnd::high,
       [](const PictureSample& at) { return at.law.inertial_number; }},
      {"viscosity", "Viscosity", "η", &PictureLabels::viscosity, true, io::LogEnd::low,
       [](const PictureSample& at) { return at.law.viscosity; }}};
  return all;
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities()) names.emplace_back(quantity.name);
  names.emplace_back(regions_name);
  names.emplace_back(mesh_name);
  return names;
}

bool shows(const PictureOptions& options, const std::string& name) {
  if (options.fields.empty()) return name != mesh_name;
  return std::ranges::count(io::split(options.fields, ','), name) > 0;
}

// Nothing if none is asked for.
std::optional<io::Window> window_in(const PictureOptions& options) {
  if (options.window.empty()) return {};
  const std::vector<std::string> parts = io::split(options.window, ',');
  if (parts.size() != 4)
    throw io::UserError("--window: '" + options.window + "' is not X,Z,X,Z, such as -1,-2,1,0.5");
  std::vector<double> w;
  for (const std::string& part : parts) w.push_back(io::real_in_range("--window", part, -1e6, 1e6));
  if (!(w[0] < w[2] && w[1] < w[3]))
    throw io::UserError("--window: '" + options.window +
                        "' is not a lower left and an upper right corner, such as -1,-2,1,0.5");
  return io::Window{{w[0], w[1]}, {w[2], w[3]}};
}

template <class Value>
std::vector<io::FieldPatch> patches_of(const std::vector<Samples>& all, const Value& value) {
  std::vector<io::FieldPatch> patches;
  for (const Samples& samples : all) {
    io::FieldPatch patch{samples.columns, {}, {}};
    for (const PictureSample& sample : samples.at) {
      patch.points.push_back(sample.at);
      patch.values.push_back(value(sample));
    }
    patches.push_back(std::move(patch));
  }
  return patches;
}

std::vector<io::Polyline> mesh_of(const std::vector<Samples>& all) {
  std::vector<io::Polyline> lines;
  for (const Samples& samples : all) {
    const std::size_t columns = samples.columns, rows = samples.rows();
    io::Polyline around;
    const auto add = [&](std::size_t row, std::size_t column) {
      around.push_back(samples.at[row * columns + column].at);
    };
    for (std::size_t i = 0; i + 1 < columns; ++i) add(0, i);
    for (std::size_t j = 0; j + 1 < rows; ++j) add(j, columns - 1);
    for (std::size_t i = columns - 1; i > 0; --i) add(rows - 1, i);
    for (std::size_t j = rows - 1; j > 0; --j) add(j, 0);
    add(0, 0);
    lines.push_back(std::move(around));
  }
  return lines;
}

// Between two of them flows the same.
std::vector<io::Polyline> streamlines_of(const std::vector<Samples>& all,
                                         const io::Window& window) {
  constexpr int count = 24;
  std::vector<io::FieldPatch> patches;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Samples& samples : all) {
    if (samples.stream.empty()) return {};
    io::FieldPatch patch{samples.columns, {}, samples.stream};
    for (const PictureSample& sample : samples.at) patch.points.push_back(sample.at);
    const auto [least, most] = std::ranges::minmax(samples.stream);
    low = std::min(low, least);
    high = std::max(high, most);
    patches.push_back(std::move(patch));
  }
  std::vector<io::Polyline> lines;
  for (int k = 0; k < count; ++k)
    for (io::Polyline& line :
         io::isolines(patches, std::lerp(low, high, (k + 0.5) / count), window))
      lines.push_back(std::move(line));
  return lines;
}

// By how much the stress exceeds the yield stress, in yield stresses, and by more than half a
// percent: so much the interior point's stress, which a plug does not determine, swings about it.
double yield_excess(const PictureSample& at, double mu_s) {
  constexpr double margin = 0.005;
  const double excess = at.stress / (mu_s * at.law.regularised_pressure) - 1 - margin;
  return std::isnan(excess) ? -1 : std::min(excess, 1.);
}

std::vector<io::FieldRegion> regions_of(const std::vector<Samples>& all, double mu_s) {
  const auto excess = [mu_s](const PictureSample& at) { return yield_excess(at, mu_s); };
  std::vector<io::FieldRegion> regions = {
      {"unyielded", "#e9e4d8", patches_of(all, [](const PictureSample&) { return 1.; })},
      {"yielded", "#a6cee3", patches_of(all, excess)},
      {"ill-posed", "#fdbf6f",
       patches_of(all,
                  [&](const PictureSample& at) {
                    const double c = at.law.well_posedness;
                    return std::isnan(c) ? -1 : std::min(excess(at), c);
                  })},
      {"p < 0", "#e31a1c",
       patches_of(all, [](const PictureSample& at) { return -at.law.total_pressure - 1e-12; })}};
  std::erase_if(regions, [](const io::FieldRegion& region) {
    return std::ranges::none_of(region.patches, [](const io::FieldPatch& patch) {
      return std::ranges::any_of(patch.values, [](double value) { return value > 0; });
    });
  });
  return regions;
}

}  // namespace

void add_pictures(io::CommandLine& line, PictureOptions& options) {
  std::string names;
  for (const std::string& name : all_names()) names += (names.empty() ? "" : ", ") + name;
  io::add_text(line, "--fields", options.fields,
               "What --plot draws of the flow, joined by commas: " + names +
                   "; all without the mesh if it is not given")
      .of_type("NAMES");
  io::add_text(line, "--window", options.window,
               "The part of the flow that --plot shows: X,Z of its lower left and X,Z of its upper "
               "right corner, as -1,-2,1,0.5")
      .of_type("BOX");
}

void check_pictures(const io::CommandLine& line, const PictureOptions& options, bool plots) {
  io::refuse_unused(line, {{{"--fields", "--window"}, plots, "a run without --plot"}});
  const auto names = all_names();
  if (!options.fields.empty())
    for (const std::string& name : io::split(options.fields, ','))
      if (std::ranges::count(names, name) == 0) {
        std::string list;
        for (const std::string& each : names) list += (list.empty() ? "" : ", ") + each;
        throw io::UserError("--fields: '" + name + "' is none of " + list +
                            io::did_you_mean(name, names));
      }
  if (options.fields == mesh_name)
    throw io::UserError("--fields: 'mesh' is drawn over a field: name one beside it");
  window_in(options);
}

io::Figure picture(const Surface& surface, const rheology::FrictionLaw& law,
                   const PictureLabels& labels, const PictureOptions& options,
                   const std::optional<io::Window>& usual_window) {
  const std::optional<io::Window> asked = window_in(options);
  const io::Window window = asked ? *asked : usual_window ? *usual_window : window_around(surface);
  const std::vector<Samples> all = samples_of(surface, window);
  io::Figure figure{labels.name, labels.caption, {}, 3, labels.title};
  const auto add = [&](const std::string& title, io::FieldMap map) {
    map.window = window;
    map.equal_axes = labels.equal_axes;
    if (shows(options, mesh_name) && !options.fields.empty()) map.mesh_lines = mesh_of(all);
    io::Panel panel{title, labels.x, labels.y, false, false, {}};
    panel.field = std::move(map);
    figure.panels.push_back(std::move(panel));
  };
  for (const Quantity& quantity : quantities()) {
    if (!shows(options, quantity.name)) continue;
    const std::string unit = quantity.unit ? labels.*quantity.unit : "";
    add(quantity.title + (unit.empty() ? "" : " / " + unit),
        {.patches = patches_of(all, quantity.value),
         .value_label = quantity.symbol,
         .log_scale = quantity.log_scale,
         .kept = quantity.kept});
  }
  if (shows(options, regions_name)) {
    const auto streamlines = streamlines_of(all, window);
    add(streamlines.empty() ? "Where it yields" : "Where it yields; streamlines",
        {.streamlines = streamlines, .regions = regions_of(all, law.mu_s)});
  }
  return figure;
}

}  // namespace talus::program
