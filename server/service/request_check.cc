#include "server/service/request_check.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/unknown_field_set.h>

#include <cmath>
#include <utility>
#include <vector>

#include "rollgait/v1/model.pb.h"
#include "server/service/watch_hub.h"

namespace rollgait::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

// Messages within a request, itself included. The most that is of use is a batch of 256 solves, with 390 each; but 4
// MiB hold two million empty ones, which take a hundred times their bytes of memory.
constexpr int64_t kMostMessages = 100'000;
// That a client is told of at once; as many numbers that are not finite as fit into a request would take a gigabyte.
constexpr size_t kMostViolations = 100;

std::string NumberText(double value) {
  if (std::isnan(value)) return "NaN";
  return value > 0 ? "+infinity" : "-infinity";
}

// Where a walk is: a field, or an element of it, of the message that `within` leads to. Paths become text only where
// something is wrong.
struct Place {
  const Place* within;  // null: the request itself
  const FieldDescriptor& field;
  int index = -1;                    // of an element
  const std::string* key = nullptr;  // of an entry of a map

  std::string Text() const {
    std::string text = within == nullptr ? "" : within->Text() + ".";
    text += std::string(field.name());
    if (index >= 0) text += "[" + std::to_string(index) + "]";
    if (key != nullptr) text += "[\"" + *key + "\"]";
    return text;
  }
};

// Walks one message tree and collects what is wrong, up to kMostViolations.
class Walker {
 public:
  explicit Walker(const std::string& prefix) : prefix_(prefix) {}
  Violations Take() { return std::move(violations_); }

  void Visit(const Message& message, const Place* place) {
    if (IsDone()) return;
    const Reflection& reflection = *message.GetReflection();
    const auto& unknown = reflection.GetUnknownFields(message);
    if (unknown.field_count() > 0) {
      violations_.push_back(
          {prefix_ + (place == nullptr ? "" : place->Text() + ".") + std::to_string(unknown.field(0).number()),
           "is a field number of " + std::string(message.GetDescriptor()->full_name()) +
               " that this server does not know; use a client of the server's version"});
    }
    std::vector<const FieldDescriptor*> fields;
    reflection.ListFields(message, &fields);
    for (const FieldDescriptor* field : fields) VisitField(message, *field, place);
  }

 private:
  bool IsDone() const { return messages_ > kMostMessages || violations_.size() >= kMostViolations; }

  void VisitField(const Message& message, const FieldDescriptor& field, const Place* within) {
    const Reflection& reflection = *message.GetReflection();
    const int size = field.is_repeated() ? reflection.FieldSize(message, &field) : 1;
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && !CountMessages(size, {within, field})) return;
    if (field.is_map()) {
      for (int i = 0; i < size && !IsDone(); ++i) {
        const Message& entry = reflection.GetRepeatedMessage(message, &field, i);
        const FieldDescriptor& key = *field.message_type()->map_key();
        const FieldDescriptor& value = *field.message_type()->map_value();
        const std::string name = entry.GetReflection()->GetString(entry, &key);
        VisitValue(entry, value, -1, {within, field, -1, &name});
      }
    } else if (field.is_repeated()) {
      for (int i = 0; i < size && !IsDone(); ++i) {
        VisitValue(message, field, i, {within, field, i});
      }
    } else {
      VisitValue(message, field, -1, {within, field});
    }
  }

  // False: with so many more in this field there are too many.
  bool CountMessages(int more, const Place& place) {
    if (IsDone()) return false;
    messages_ += more;
    if (messages_ <= kMostMessages) return true;
    violations_.push_back({prefix_ + place.Text(), "has " + std::to_string(more) + " entries; a request has at most " +
                                                       std::to_string(kMostMessages) + " in all its fields"});
    return false;
  }

  // One value: element `index` of a repeated field, or a single field if the index is -1.
  void VisitValue(const Message& message, const FieldDescriptor& field, int index, const Place& place) {
    const Reflection& reflection = *message.GetReflection();
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_DOUBLE:
        if (MayBeInfinite(field) && std::isinf(reflection.GetDouble(message, &field))) break;
        CheckFinite(
            index < 0 ? reflection.GetDouble(message, &field) : reflection.GetRepeatedDouble(message, &field, index),
            place);
        break;
      case FieldDescriptor::CPPTYPE_FLOAT:
        CheckFinite(
            index < 0 ? reflection.GetFloat(message, &field) : reflection.GetRepeatedFloat(message, &field, index),
            place);
        break;
      case FieldDescriptor::CPPTYPE_ENUM:
        CheckEnum(field,
                  index < 0 ? reflection.GetEnumValue(message, &field)
                            : reflection.GetRepeatedEnumValue(message, &field, index),
                  place);
        break;
      case FieldDescriptor::CPPTYPE_MESSAGE:
        Visit(
            index < 0 ? reflection.GetMessage(message, &field) : reflection.GetRepeatedMessage(message, &field, index),
            &place);
        break;
      default:
        break;
    }
  }

  // Limits of joints of an own model, which the base has not.
  static bool MayBeInfinite(const FieldDescriptor& field) {
    if (field.containing_type() != v1::Joint::descriptor()) return false;
    for (const int number :
         {v1::Joint::kPositionMinFieldNumber, v1::Joint::kPositionMaxFieldNumber, v1::Joint::kVelocityMaxFieldNumber}) {
      if (field.number() == number) return true;
    }
    return false;
  }

  void CheckFinite(double value, const Place& place) {
    if (std::isfinite(value)) return;
    violations_.push_back({prefix_ + place.Text(), "is " + NumberText(value) + ", must be a finite number"});
  }

  void CheckEnum(const FieldDescriptor& field, int value, const Place& place) {
    if (field.enum_type()->FindValueByNumber(value) != nullptr) return;
    violations_.push_back({prefix_ + place.Text(), "is " + std::to_string(value) + ", which " +
                                                       std::string(field.enum_type()->full_name()) + " does not have"});
  }

  const std::string prefix_;
  int64_t messages_ = 1;
  Violations violations_;
};

// Bytes of one field, roughly: enough to tell which is the large one.
size_t FieldBytes(const Message& message, const FieldDescriptor& field) {
  if (field.is_repeated()) return static_cast<size_t>(message.GetReflection()->FieldSize(message, &field));
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
    return message.GetReflection()->GetString(message, &field).size();
  }
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
    return message.GetReflection()->GetMessage(message, &field).ByteSizeLong();
  }
  return sizeof(double);
}

}  // namespace

Violations CheckWellFormed(const Message& message, const std::string& prefix) {
  Walker walker(prefix);
  walker.Visit(message, nullptr);
  return walker.Take();
}

Violations CheckSize(const Message& request) {
  const size_t bytes = request.ByteSizeLong();
  if (bytes <= static_cast<size_t>(kMaxRequestBytes)) return {};
  std::vector<const FieldDescriptor*> fields;
  request.GetReflection()->ListFields(request, &fields);
  std::string name = "request";
  size_t largest = 0;
  for (const FieldDescriptor* field : fields) {
    const size_t size = FieldBytes(request, *field);
    if (size > largest) {
      largest = size;
      name = field->name();
    }
  }
  return {{name, "makes the request " + std::to_string(bytes) + " bytes long, the limit is " +
                     std::to_string(kMaxRequestBytes) + " bytes"}};
}

Violations CheckRequest(const Message& request) {
  Violations violations = CheckSize(request);
  if (violations.empty()) violations = CheckWellFormed(request, "");
  return violations;
}

void AddPrefix(const std::string& prefix, Violations& violations) {
  for (Violation& violation : violations) violation.field.insert(0, prefix);
}

int CheckPageSize(int asked, Violations* violations) {
  constexpr int kDefault = 50, kMost = 1000;
  if (asked < 0 || asked > kMost) {
    violations->push_back({"page_size", "is " + std::to_string(asked) + ", must be from 1 to " + std::to_string(kMost) +
                                            " (0: " + std::to_string(kDefault) + ")"});
  }
  return asked == 0 ? kDefault : asked;
}

Violations CheckRequestId(const std::string& request_id) {
  constexpr size_t kLimit = 128;
  if (request_id.size() > kLimit) {
    return {{"request_id",
             "is " + std::to_string(request_id.size()) + " characters long, the limit is " + std::to_string(kLimit)}};
  }
  for (const char letter : request_id) {
    if (letter < ' ' || letter > '~') {
      return {{"request_id", "holds the byte " + std::to_string(static_cast<unsigned char>(letter)) +
                                 ", only printable ASCII characters are allowed"}};
    }
  }
  return {};
}

Violations CheckPriority(int priority) {
  if (priority >= kLeastPriority && priority <= kMostPriority) return {};
  return {{"priority", "is " + std::to_string(priority) + ", must be from " + std::to_string(kLeastPriority) + " to " +
                           std::to_string(kMostPriority)}};
}

Violations CheckIterates(int per_second, const std::string& field) {
  if (per_second >= 0 && per_second <= kMostIteratesPerSecond) return {};
  return {{field, "is " + std::to_string(per_second) + ", must be in [0, " + std::to_string(kMostIteratesPerSecond) +
                      "]; 0: none"}};
}

Error InvalidArgument(Violations violations) {
  ROLLGAIT_CHECK(!violations.empty());
  std::string message = violations[0].field + " " + violations[0].message;
  if (violations.size() > 1) message += " (and " + std::to_string(violations.size() - 1) + " more)";
  return {ErrorCode::kInvalidArgument, std::move(message), std::move(violations)};
}

}  // namespace rollgait::server
