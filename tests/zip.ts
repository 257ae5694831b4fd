/** Zip archives for tests, including hostile ones. */
import { deflateRawSync } from "node:zlib";
import { crc32 } from "../web/client/build/crc32";

/** A file to be packed. */
export interface Packed {
  name: string;
  content: string | Uint8Array;
  /** Claimed unpacked size, instead of the true one. */
  claimedBytes?: number;
  /** Whether it is stored uncompressed. */
  stored?: boolean;
}

/** Returns an archive of these files. `wide` writes counts and offsets with 64 bits, as archives of over 4 GB must. */
export function zipOf(files: readonly Packed[], wide = false): Uint8Array<ArrayBuffer> {
  const bodies: Buffer[] = [];
  const directory: Buffer[] = [];
  let offset = 0;
  for (const { name, content, claimedBytes, stored } of files) {
    const bytes = Buffer.from(content);
    const packed = stored ? bytes : deflateRawSync(bytes);
    const nameBytes = Buffer.from(name);
    // Version, flags (names are UTF-8), method, time, date, checksum, sizes, length of the name.
    const fields = Buffer.alloc(26);
    fields.writeUInt16LE(20, 0);
    fields.writeUInt16LE(0x800, 2);
    fields.writeUInt16LE(stored ? 0 : 8, 4);
    fields.writeUInt32LE(crc32(bytes), 10);
    fields.writeUInt32LE(packed.length, 14);
    fields.writeUInt32LE(claimedBytes ?? bytes.length, 18);
    fields.writeUInt16LE(nameBytes.length, 22);
    const body = Buffer.concat([Buffer.from("PK\x03\x04"), fields, nameBytes, packed]);
    const trailer = Buffer.alloc(14);
    trailer.writeUInt32LE(wide ? 0xffffffff : offset, 10);
    const extra = Buffer.alloc(wide ? 12 : 0);
    if (wide) {
      extra.writeUInt16LE(1, 0);
      extra.writeUInt16LE(8, 2);
      extra.writeBigUInt64LE(BigInt(offset), 4);
    }
    const entry = Buffer.from(fields);
    entry.writeUInt16LE(extra.length, 24);
    directory.push(Buffer.concat([Buffer.from("PK\x01\x02\x14\0"), entry, trailer, nameBytes, extra]));
    bodies.push(body);
    offset += body.length;
  }
  const entries = Buffer.concat(directory);
  const end = Buffer.alloc(22);
  end.write("PK\x05\x06");
  end.writeUInt16LE(wide ? 0xffff : files.length, 8);
  end.writeUInt16LE(wide ? 0xffff : files.length, 10);
  end.writeUInt32LE(wide ? 0xffffffff : entries.length, 12);
  end.writeUInt32LE(wide ? 0xffffffff : offset, 16);
  const wideEnd = wide ? [wideEndOf(files.length, entries.length, offset)] : [];
  return Uint8Array.from(Buffer.concat([...bodies, entries, ...wideEnd, end]));
}

/** Returns the 64-bit end of the directory, and its position. */
function wideEndOf(count: number, bytes: number, offset: number): Buffer {
  const end = Buffer.alloc(56 + 20);
  end.write("PK\x06\x06");
  end.writeBigUInt64LE(44n, 4);
  end.writeBigUInt64LE(BigInt(count), 24);
  end.writeBigUInt64LE(BigInt(count), 32);
  end.writeBigUInt64LE(BigInt(bytes), 40);
  end.writeBigUInt64LE(BigInt(offset), 48);
  end.write("PK\x06\x07", 56);
  end.writeBigUInt64LE(BigInt(offset + bytes), 64);
  end.writeUInt32LE(1, 72);
  return end;
}
