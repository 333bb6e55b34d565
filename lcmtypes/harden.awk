# Hardens a C++ header of lcm-gen 1.3: 20 bytes can crash its stock decode(), which trusts array
# counts and string lengths. Usage: awk -f harden.awk hello_t.hpp > hardened.hpp
#
#   arrays   count < 0 or beyond the bytes that are left: return -1 before the resize
#   strings  length < 1 or beyond the bytes that are left, or no NUL at the end: return -1
#   floats   copied through integers: the stock cast of float* to int32_t* breaks strict aliasing;
#            doubles likewise
#
# Exits with status 1 and one line on an allocation that it cannot guard, so that a newer lcm-gen
# or a new kind of field cannot slip through. Works with mawk and gawk.

function fail(why) {
  print FILENAME ":" FNR ": harden.awk: " why ": " $0 | "cat 1>&2"
  failed = 1
  exit 1
}

# Returns the text between the first `from` and the next `to` in the line.
function between(from, to,    rest) {
  rest = substr($0, index($0, from) + length(from))
  return substr(rest, 1, index(rest, to) - 1)
}

# Replaces the stock check of a string and remembers that an assign must follow.
/^    if\(__[A-Za-z0-9_]*_len__ > maxlen - pos\) return -1;$/ {
  n = between("if(", " >")
  print "    if(" n " < 1 || " n " > maxlen - pos) return -1;"
  print "    if(((const char*)buf)[offset + pos + " n " - 1] != 0) return -1;"
  checked = n
  next
}

/assign\(/ {
  if (checked == "" || index($0, "offset + pos, " checked " - 1);") == 0) fail("unguarded string")
  checked = ""
  guarded++
}

/resize\(/ {
  if ($0 !~ /^        this->[a-z0-9_]+\.resize\(this->[a-z0-9_]+\);$/) fail("unguarded resize")
  n = between("resize(", ")")
  print "        if(" n " < 0 || " n " > maxlen - pos) return -1;"
  guarded++
}

/(reserve|malloc|calloc|new|alloc)[ (]/ && !/^ *[\/*]/ { fail("unknown allocation") }

# Codes a float or double, or an array of them, through a vector of integers with the same bits.
/__(float|double)_(de|en)code_array\(buf, offset \+ pos, maxlen - pos, &this->/ &&
/&this->[a-z0-9_]+(\[0\], this->[a-z0-9_]+|, 1)\);$/ {
  array = index($0, "[0], ") > 0
  real = $0 ~ /__float_/ ? "float" : "double"
  integer = real == "float" ? "int32_t" : "int64_t"
  values = array ? "this->" between("&this->", "[0]") ".data()" : "&this->" between("&this->", ",")
  n = array ? between("[0], ", ")") : "1"
  bits = "__bits__.data()"
  bytes = "sizeof(" real ") * __bits__.size()"
  where = "(buf, offset + pos, maxlen - pos, " bits ", "
  if (!array) print "    {"
  print "        std::vector< " integer " > __bits__(" n ");"
  if ($0 ~ /decode/) {
    print "        tlen = __" integer "_decode_array" where n ");"
    print "        memcpy(" values ", " bits ", " bytes ");"
  } else {
    print "        memcpy(" bits ", " values ", " bytes ");"
    print "        tlen = __" integer "_encode_array" where n ");"
  }
  if (!array) print "    }"
  next
}
/__(float|double)_(de|en)code_array\(/ { fail("a floating-point field of an unknown form") }

/_decodeNoHash\(const void \*buf.*\)$/ { decoders++ }

{ print }

END {
  if (failed) exit 1
  if (decoders != 1) {
    print FILENAME ": harden.awk: expected one decoder, found " decoders + 0 | "cat 1>&2"
    exit 1
  }
}
