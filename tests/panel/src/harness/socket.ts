// A WebSocket of bytes, for what a browser would not send and would not leave unread.
import { randomBytes } from 'node:crypto';
import { connect, type Socket } from 'node:net';
import type { Rest } from './rest';
import { until } from './waiting';

export interface Frame {
  readonly opcode: number;
  readonly payload: Buffer;
}

export function frameOf(payload: Buffer | string, opcode = 1): Buffer {
  const body = Buffer.from(payload);
  const mask = randomBytes(4);
  const head = body.length < 126 ? Buffer.from([0x80 | opcode, 0x80 | body.length])
    : Buffer.from([0x80 | opcode, 0x80 | 126, body.length >> 8, body.length & 255]);
  return Buffer.concat([head, mask, body.map((byte, i) => byte ^ mask[i & 3]!)]);
}

export class RawSocket {
  readonly frames: Frame[] = [];
  /** What came when the upgrade was refused. */
  refusal = '';
  closed = false;
  private rest = Buffer.alloc(0);
  private open = false;

  private constructor(readonly socket: Socket) {}

  static async connect(rest: Rest, headers: { readonly [name: string]: string } = {}): Promise<RawSocket> {
    const { hostname, port } = new URL(rest.base);
    const raw = new RawSocket(connect(Number(port), hostname));
    const lines = {
      Host: `${hostname}:${port}`, Upgrade: 'websocket', Connection: 'Upgrade', Origin: rest.base, 'Sec-WebSocket-Version': '13',
      'Sec-WebSocket-Key': randomBytes(16).toString('base64'), 'Sec-WebSocket-Protocol': 'flexrf.v1',
      ...(rest.cookie && { Cookie: rest.cookie }), ...headers,
    };
    raw.socket.on('data', (part) => raw.take(part));
    raw.socket.on('error', () => { raw.closed = true; });
    raw.socket.on('close', () => { raw.closed = true; });
    raw.socket.write(`GET /api/v1/live HTTP/1.1\r\n${Object.entries(lines).map(([name, value]) => `${name}: ${value}\r\n`).join('')}\r\n`);
    await until(() => raw.open || raw.closed || raw.refusal !== '' || undefined, () => 'the server did not answer the upgrade');
    return raw;
  }

  send(message: object): void {
    this.socket.write(frameOf(JSON.stringify(message)));
  }

  get texts(): { [name: string]: unknown }[] {
    return this.frames.filter((frame) => frame.opcode === 1).map((frame) => JSON.parse(frame.payload.toString('utf8')));
  }
  get values(): number {
    return this.frames.filter((frame) => frame.opcode === 2).length;
  }
  /** Of the close frame that came; undefined: none did. */
  get closeCode(): number | undefined {
    return this.frames.find((frame) => frame.opcode === 8)?.payload.readUInt16BE(0);
  }

  end(): void {
    this.socket.destroy();
  }

  private take(part: Buffer): void {
    this.rest = Buffer.concat([this.rest, part]);
    if (!this.open) {
      const end = this.rest.indexOf('\r\n\r\n');
      if (end < 0) return;
      const head = this.rest.subarray(0, end).toString('latin1');
      if (!head.startsWith('HTTP/1.1 101')) {
        this.refusal = head;
        return;
      }
      this.open = true;
      this.rest = this.rest.subarray(end + 4);
    }
    for (;;) {
      if (this.rest.length < 2) return;
      let length = this.rest[1]! & 127;
      let at = 2;
      if (length === 126) {
        if (this.rest.length < 4) return;
        length = this.rest.readUInt16BE(2);
        at = 4;
      } else if (length === 127) {
        if (this.rest.length < 10) return;
        length = Number(this.rest.readBigUInt64BE(2));
        at = 10;
      }
      if (this.rest.length < at + length) return;
      this.frames.push({ opcode: this.rest[0]! & 15, payload: Buffer.from(this.rest.subarray(at, at + length)) });
      this.rest = this.rest.subarray(at + length);
    }
  }
}
