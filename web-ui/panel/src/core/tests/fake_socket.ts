// The other end of a connection, in the hands of a test.
import type { Socket } from '../connection';

export class FakeSocket implements Socket {
  binaryType: BinaryType = 'blob';
  readyState = 0;
  onopen: Socket['onopen'] = null;
  onmessage: Socket['onmessage'] = null;
  onclose: Socket['onclose'] = null;
  onerror: Socket['onerror'] = null;
  readonly sent: Record<string, unknown>[] = [];

  send(text: string): void {
    this.sent.push(JSON.parse(text) as Record<string, unknown>);
  }
  close(): void {
    this.readyState = 3;
  }

  /** Messages of one operation, in the order sent. */
  of(op: string): Record<string, unknown>[] {
    return this.sent.filter((message) => message['op'] === op);
  }
  say(message: object | ArrayBuffer | string): void {
    const data = typeof message === 'string' || message instanceof ArrayBuffer ? message : JSON.stringify(message);
    this.onmessage?.(new MessageEvent('message', { data }));
  }
  hello(fields: object = {}): void {
    this.readyState = 1;
    this.say({
      event: 'hello', protocol: 1, application: 'sample', boot: 'a', descriptor: '84bdd5562b9e2e53', drivers: {},
      null_reasons: ['none', 'nothing yet', 'too old'],
      session: { name: 'panel-1', role: 'operator', local: true, user: '' }, server_time_ns: 5_000_000_000, ...fields,
    });
  }
  lose(reason = ''): void {
    this.readyState = 3;
    this.onclose?.(new CloseEvent('close', { reason }));
  }
}
