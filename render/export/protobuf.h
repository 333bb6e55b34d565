#pragma once
/// Protocol buffers: the encoding of a message (https://protobuf.dev/programming-guides/encoding),
/// and the schemas that MCAP files carry (google.protobuf.FileDescriptorSet).

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace seam {

/// Encodes the fields of one message, in the order of the calls. Numbers that are 0 are left out:
/// proto3 reads an absent number as 0.
class ProtoMessage {
 public:
  void Varint(int field, std::uint64_t value);
  void Fixed32(int field, std::uint32_t value);
  void Float(int field, float value);
  void Double(int field, double value);
  /// Adds a string, bytes, or an encoded message, also when empty.
  void Bytes(int field, std::string_view value);
  const std::string& bytes() const { return bytes_; }
  /// Appends the four bytes of a float to data of a field, least byte first.
  static void AppendFloat(float value, std::string* data);

 private:
  void Key(int field, int wire_type);
  void Raw(std::uint64_t value);
  void LittleEndian(std::uint64_t value, int bytes);

  std::string bytes_;
};

/// Types of fields, with their numbers in google.protobuf.FieldDescriptorProto.
enum class ProtoType {
  kDouble = 1,
  kFloat = 2,
  kInt64 = 3,
  kInt32 = 5,
  kFixed32 = 7,
  kBool = 8,
  kString = 9,
  kMessage = 11,
  kBytes = 12,
  kEnum = 14
};

struct ProtoField {
  const char* name;
  int number;
  ProtoType type;
  const char* of = "";  ///< full name of a message or enum type: ".foxglove.Pose"
  bool repeated = false;
};

struct ProtoEnum {
  const char* name;
  std::vector<const char*> values;  ///< numbered from 0
};

struct ProtoSchema {
  const char* name;  ///< within its package
  std::vector<ProtoField> fields;
  std::vector<ProtoEnum> enums = {};
};

struct ProtoFile {
  const char* name;
  const char* package;
  std::vector<const char*> imports;
  std::vector<ProtoSchema> messages;
};

/// Returns an encoded google.protobuf.FileDescriptorSet. Requires that a file comes after those
/// that it imports.
std::string DescriptorSet(const std::vector<ProtoFile>& files);

}  // namespace seam
