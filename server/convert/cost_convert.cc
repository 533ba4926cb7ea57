#include "server/convert/cost_convert.h"

#include "core/base/check.h"
#include "server/convert/field_decoding.h"

namespace rollgait::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

std::optional<double> DecodeNumber(const Message& message, const char* name) {
  const FieldDescriptor* field = FieldOf(message, name);
  const Reflection& fields = *message.GetReflection();
  return fields.HasField(message, field) ? std::optional(fields.GetDouble(message, field)) : std::nullopt;
}

void EncodeNumber(const std::optional<double>& number, const char* name, Message* message) {
  if (number) message->GetReflection()->SetDouble(message, FieldOf(*message, name), *number);
}

// Of map<string, double>; entries have the fields key and value.
JointWeights DecodeWeights(const Message& message) {
  const FieldDescriptor* field = FieldOf(message, "joint_weights");
  const Reflection& fields = *message.GetReflection();
  JointWeights weights;
  for (int i = 0; i < fields.FieldSize(message, field); ++i) {
    const Message& entry = fields.GetRepeatedMessage(message, field, i);
    const Reflection& of_entry = *entry.GetReflection();
    weights[of_entry.GetString(entry, FieldOf(entry, "key"))] = of_entry.GetDouble(entry, FieldOf(entry, "value"));
  }
  return weights;
}

void EncodeWeights(const JointWeights& weights, Message* message) {
  const FieldDescriptor* field = FieldOf(*message, "joint_weights");
  for (const auto& [joint, weight] : weights) {
    Message* entry = message->GetReflection()->AddMessage(message, field);
    entry->GetReflection()->SetString(entry, FieldOf(*entry, "key"), joint);
    entry->GetReflection()->SetDouble(entry, FieldOf(*entry, "value"), weight);
  }
}

std::vector<cost::Tracking::Channel> DecodeChannels(const v1::CostTerm::Tracking& tracking) {
  std::vector<cost::Tracking::Channel> channels;
  for (const v1::CostTerm::Tracking::Channel& channel : tracking.channels()) {
    channels.push_back({channel.joint(),
                        {channel.positions().begin(), channel.positions().end()},
                        ROLLGAIT_OPTIONAL(channel, weight)});
  }
  return channels;
}

void EncodeChannels(const std::vector<cost::Tracking::Channel>& channels, v1::CostTerm::Tracking* tracking) {
  for (const cost::Tracking::Channel& channel : channels) {
    v1::CostTerm::Tracking::Channel& encoded = *tracking->add_channels();
    encoded.set_joint(channel.joint);
    encoded.mutable_positions()->Add(channel.positions.begin(), channel.positions.end());
    if (channel.weight) encoded.set_weight(*channel.weight);
  }
}

template <typename Term>
Term DecodeTerm(const CostRow<Term>& row, const v1::CostTerm& cost, const Message& message) {
  Term term;
  row.ForEachParameter(
      [&](const CostParameter<Term>& parameter) { term.*parameter.member = DecodeNumber(message, parameter.field); });
  if constexpr (HasJointWeights<Term>) term.joint_weights = DecodeWeights(message);
  if constexpr (HasChannels<Term>) term.channels = DecodeChannels(cost.tracking());
  return term;
}

// Sets the field of the term's kind, in the oneof, to the term.
struct TermEncoder {
  v1::CostTerm* cost;

  template <typename Term>
  void operator()(const Term& term) const {
    const CostRow<Term>& row = RowOf<Term>();
    Message* message = cost->GetReflection()->MutableMessage(cost, FieldOf(*cost, row.traits.field));
    row.ForEachParameter(
        [&](const CostParameter<Term>& parameter) { EncodeNumber(term.*parameter.member, parameter.field, message); });
    if constexpr (HasJointWeights<Term>) EncodeWeights(term.joint_weights, message);
    if constexpr (HasChannels<Term>) EncodeChannels(term.channels, cost->mutable_tracking());
  }
};

}  // namespace

v1::CostTerm EncodeCost(const GaitRequest::CostTerm& cost) {
  v1::CostTerm encoded;
  std::visit(TermEncoder{&encoded}, cost.term);
  if (cost.weight) encoded.set_weight(*cost.weight);
  return encoded;
}

GaitRequest::CostTerm DecodeCost(const std::string& field, const v1::CostTerm& cost, Violations* violations) {
  GaitRequest::CostTerm decoded;
  decoded.weight = ROLLGAIT_OPTIONAL(cost, weight);
  const FieldDescriptor* given =
      cost.GetReflection()->GetOneofFieldDescriptor(cost, v1::CostTerm::descriptor()->FindOneofByName("term"));
  if (given == nullptr) {
    violations->push_back({field, "no term; set one, for example squared_torque"});
    return decoded;
  }
  bool known = false;
  ForEachCost([&](const auto& row) {
    if (given->name() != row.traits.field) return;
    decoded.term = DecodeTerm(row, cost, cost.GetReflection()->GetMessage(cost, given));
    known = true;
  });
  ROLLGAIT_CHECK(known);  // a test holds table and proto together
  return decoded;
}

}  // namespace rollgait::server
