#include "render/export/protobuf.h"

#include <cstring>

namespace seam {
namespace {

constexpr int kWireVarint = 0, kWire64 = 1, kWireBytes = 2, kWire32 = 5;

// Numbers of fields in google/protobuf/descriptor.proto.
std::string DescriptorOf(const ProtoField& field) {
  constexpr int kOptional = 1, kRepeated = 3;
  ProtoMessage out;
  out.Bytes(1, field.name);
  out.Varint(3, static_cast<std::uint64_t>(field.number));
  out.Varint(4, field.repeated ? kRepeated : kOptional);
  out.Varint(5, static_cast<std::uint64_t>(field.type));
  if (*field.of != '\0') out.Bytes(6, field.of);
  return out.bytes();
}

std::string DescriptorOf(const ProtoEnum& names) {
  ProtoMessage out;
  out.Bytes(1, names.name);
  for (std::size_t i = 0; i < names.values.size(); ++i) {
    ProtoMessage value;
    value.Bytes(1, names.values[i]);
    value.Varint(2, i);
    out.Bytes(2, value.bytes());
  }
  return out.bytes();
}

std::string DescriptorOf(const ProtoSchema& schema) {
  ProtoMessage out;
  out.Bytes(1, schema.name);
  for (const ProtoField& field : schema.fields) out.Bytes(2, DescriptorOf(field));
  for (const ProtoEnum& names : schema.enums) out.Bytes(4, DescriptorOf(names));
  return out.bytes();
}

}  // namespace

void ProtoMessage::Raw(std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes_ += static_cast<char>(value | 0x80);
  bytes_ += static_cast<char>(value);
}

void ProtoMessage::Key(int field, int wire_type) {
  Raw(static_cast<std::uint64_t>(field) << 3 | static_cast<std::uint64_t>(wire_type));
}

void ProtoMessage::LittleEndian(std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) bytes_ += static_cast<char>(value >> (8 * i));
}

void ProtoMessage::Varint(int field, std::uint64_t value) {
  if (value == 0) return;
  Key(field, kWireVarint);
  Raw(value);
}

void ProtoMessage::Fixed32(int field, std::uint32_t value) {
  if (value == 0) return;
  Key(field, kWire32);
  LittleEndian(value, 4);
}

void ProtoMessage::AppendFloat(float value, std::string* data) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  for (int i = 0; i < 4; ++i) *data += static_cast<char>(bits >> (8 * i));
}

void ProtoMessage::Float(int field, float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  Fixed32(field, bits);
}

void ProtoMessage::Double(int field, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  if (bits == 0) return;
  Key(field, kWire64);
  LittleEndian(bits, 8);
}

void ProtoMessage::Bytes(int field, std::string_view value) {
  Key(field, kWireBytes);
  Raw(value.size());
  bytes_ += value;
}

std::string DescriptorSet(const std::vector<ProtoFile>& files) {
  ProtoMessage set;
  for (const ProtoFile& file : files) {
    ProtoMessage out;
    out.Bytes(1, file.name);
    out.Bytes(2, file.package);
    for (const char* import : file.imports) out.Bytes(3, import);
    for (const ProtoSchema& schema : file.messages) out.Bytes(4, DescriptorOf(schema));
    out.Bytes(12, "proto3");
    set.Bytes(1, out.bytes());
  }
  return set.bytes();
}

}  // namespace seam
