#include "client/formats/stride_csv.h"

#include <functional>
#include <utility>
#include <vector>

#include "client/formats/exact_number.h"
#include "client/formats/exported_stride.h"
#include "client/formats/ground_reaction.h"
#include "client/report/kinematics.h"

namespace rollgait::client {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

// What the table is made of, and its columns by name.
class StrideTable {
 public:
  explicit StrideTable(const v1::Solve& solve)
      : model_(solve.result().model()), stride_(ExportedStride(solve)), plates_(FootPlates(solve)) {
    for (const Plate& plate : plates_) reactions_.push_back(Reactions(stride_, model_, plate));
    for (const StrideSample& sample : stride_.samples) poses_.push_back(LinkPoses(model_, sample.instant.position));
    AddMotion();
    AddFeet();
    AddSurfaces();
  }

  std::string Text() const {
    std::string text;
    for (size_t j = 0; j < columns_.size(); ++j) text += (j == 0 ? "" : ",") + columns_[j].name;
    text += "\n";
    for (size_t row = 0; row < stride_.samples.size(); ++row) {
      for (size_t j = 0; j < columns_.size(); ++j) text += (j == 0 ? "" : ",") + Exact(columns_[j].value(row));
      text += "\n";
    }
    return text;
  }

 private:
  using Value = std::function<double(size_t)>;
  struct Column {
    std::string name;
    Value value;
  };

  const Instant& At(size_t row) const { return stride_.samples[row].instant; }
  void Add(const std::string& name, Value value) { columns_.push_back({name, std::move(value)}); }

  void AddMotion() {
    Add("percent", [this](size_t row) { return stride_.samples[row].percent; });
    Add("time_s", [this](size_t row) { return stride_.samples[row].time_s; });
    for (int i = 0; i < model_.joints_size(); ++i) {
      Add(model_.joints(i).name(), [this, i](size_t row) { return At(row).position[i]; });
      Add(model_.joints(i).name() + ".velocity", [this, i](size_t row) { return At(row).velocity[i]; });
    }
    for (int i = 0; i < model_.joints_size(); ++i) {
      if (!model_.joints(i).actuated()) continue;
      Add(model_.joints(i).name() + ".effort", [this, i](size_t row) { return At(row).effort[i]; });
    }
  }

  void AddFeet() {
    for (size_t p = 0; p < plates_.size(); ++p) {
      for (int k = 0; k < 3; ++k) {
        Add(plates_[p].name + ".force_" + kAxes[k], [this, p, k](size_t row) { return reactions_[p][row].force(k); });
      }
    }
    for (size_t p = 0; p < plates_.size(); ++p) {
      for (int k = 0; k < 2; ++k) {
        Add(plates_[p].name + ".pressure_" + kAxes[k],
            [this, p, k](size_t row) { return reactions_[p][row].point(k); });
      }
      Add(plates_[p].name + ".free_moment", [this, p](size_t row) { return reactions_[p][row].couple.z(); });
    }
  }

  void AddSurfaces() {
    for (int c = 0; c < model_.contacts_size(); ++c) {
      const std::string& name = model_.contacts(c).name();
      for (int k = 0; k < 3; ++k) {
        Add(name + ".force_" + kAxes[k], [this, c, k](size_t row) { return At(row).force[c][k]; });
      }
      for (int k = 0; k < 3; ++k) {
        Add(name + ".point_" + kAxes[k],
            [this, c, k](size_t row) { return LowestPoint(model_.contacts(c), poses_[row])(k); });
      }
    }
  }

  const v1::Model& model_;
  const Stride stride_;
  const std::vector<Plate> plates_;
  std::vector<std::vector<Reaction>> reactions_;  // of each plate, at each sample
  std::vector<std::vector<Pose>> poses_;          // at each sample
  std::vector<Column> columns_;
};

}  // namespace

std::string ToStrideCsv(const v1::Solve& solve) { return StrideTable(solve).Text(); }

}  // namespace rollgait::client
