// Decodes the page's data: base64 of gzip of a head (JSON) and of sections of varints. The layout
// is defined in render/page/tracks.h and render/page/document.h.
'use strict';

class Reader {
  constructor(bytes, [at, length]) {
    this.bytes = bytes;
    this.at = at;
    this.end = at + length;
  }
  unsigned() {
    let value = 0;
    for (let weight = 1;; weight *= 128) {
      if (this.at >= this.end) throw new Error('the data of this page is cut off');
      const byte = this.bytes[this.at++];
      value += (byte & 127) * weight;
      if (byte < 128) return value;
    }
  }
  signed() {
    const value = this.unsigned();
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  }
  // Calls put(index, value) for each value of a column of runs.
  runs(put) {
    const count = this.unsigned();
    for (let run = 0, index = 0; run < count; ++run) {
      const length = this.unsigned();
      const value = this.signed();
      for (let k = 0; k < length; ++k) put(index++, value);
    }
  }
}

async function inflate(base64) {
  const text = atob(base64.trim());
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Returns {head, bytes}: the head has the places of the sections in the bytes.
function splitData(data) {
  const length = new DataView(data.buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(data.subarray(4, 4 + length)));
  return {head, bytes: data.subarray(4 + length)};
}

function readJson(bytes, [at, length]) {
  return JSON.parse(new TextDecoder().decode(bytes.subarray(at, at + length)));
}

function readSpans(reader) {
  const spans = [];
  let at = 0;
  for (let k = reader.unsigned(); k > 0; --k) {
    const begin = at + reader.signed();
    at = begin + reader.unsigned();
    spans.push([begin, at]);
  }
  return spans;
}

function readTrack(reader, count, isView) {
  const track = {id: reader.signed(), spans: readSpans(reader), has: new Uint8Array(count)};
  for (const [begin, end] of track.spans) track.has.fill(1, begin, end);
  for (const name of ['x', 'y', 'a']) {
    const column = (track[name] = new Int32Array(count));
    for (const [begin, end] of track.spans) {
      let last = 0;
      let step = 0;
      for (let i = begin; i < end; ++i) {
        const value = last + step + reader.signed();
        step = i === begin ? 0 : value - last;
        column[i] = last = value;
      }
    }
  }
  if (!isView) return track;
  const places = [];
  for (const [begin, end] of track.spans)
    for (let i = begin; i < end; ++i) places.push(i);
  track.owner = new Int16Array(count);
  track.error = new Int32Array(count).fill(-1);
  reader.runs((index, value) => (track.owner[places[index]] = value));
  let error = 0;
  for (const i of places) {
    error += reader.signed();
    track.error[i] = error - 1;
  }
  track.age = new Int32Array(count);
  let age = 0;
  for (const i of places) track.age[i] = age += reader.signed();
  return track;
}

// Returns {first, count, world, bodies}: poses in mm and mrad, by body; errors and ages in the
// head's units.
function readTracks(bytes, section, isView) {
  const reader = new Reader(bytes, section);
  const first = reader.signed();
  const count = reader.unsigned();
  const world = new Int32Array(count);
  reader.runs((index, value) => (world[index] = value));
  const bodies = new Map();
  for (let k = reader.unsigned(); k > 0; --k) {
    const track = readTrack(reader, count, isView);
    bodies.set(track.id, track);
  }
  return {first, count, world, bodies};
}

// Returns {count, root}: by tick, the number of differences and their root mean square.
function readSeries(bytes, section, unit) {
  const reader = new Reader(bytes, section);
  const length = reader.unsigned();
  const column = () => {
    let value = 0;
    return Float64Array.from({length}, () => (value += reader.signed()));
  };
  const count = column();
  const root = column().map((value) => value * unit);
  return {count, root};
}

// Returns {part, width, points, rowOf, columns} for each strand of a view: x and y of each point in
// mm, by row, and the row of each tick.
function readStrands(bytes, section) {
  const reader = new Reader(bytes, section);
  return Array.from({length: reader.unsigned()}, () => {
    reader.unsigned();
    const strand = {part: reader.signed(), width: reader.signed() / 1000};
    strand.points = reader.unsigned();
    const length = reader.unsigned();
    const column = () => {
      let value = 0;
      return Array.from({length}, () => (value += reader.signed()));
    };
    strand.rowOf = new Map(column().map((tick, row) => [tick, row]));
    strand.columns = Array.from({length: 2 * strand.points}, column);
    return strand;
  });
}

// Returns [left, bottom, width, height] of each block of bricks, units of 5 cm.
function readBricks(bytes, section) {
  const reader = new Reader(bytes, section);
  const count = reader.unsigned();
  const columns = [0, 1, 2, 3].map(() => {
    let value = 0;
    return Array.from({length: count}, () => (value += reader.signed()));
  });
  return columns[0].map((_, i) => columns.map((column) => column[i]));
}
