// A cable between browser and application that can be cut: nothing goes through, and neither end is told.
import { connect, createServer, type Server, type Socket } from 'node:net';
import type { AddressInfo } from 'node:net';

export class Cable {
  private readonly server: Server;
  private readonly pairs = new Set<readonly [Socket, Socket]>();
  private isCut = false;

  private constructor(private readonly port: number) {
    this.server = createServer((near) => this.join(near));
  }

  static async to(port: number): Promise<Cable> {
    const cable = new Cable(port);
    await new Promise<void>((resolve) => cable.server.listen(0, '127.0.0.1', resolve));
    return cable;
  }

  get base(): string {
    return `http://127.0.0.1:${(this.server.address() as AddressInfo).port}`;
  }

  cut(): void {
    this.isCut = true;
    for (const pair of this.pairs) pair.forEach((socket) => socket.pause());
  }

  mend(): void {
    this.isCut = false;
    for (const pair of this.pairs) pair.forEach((socket) => socket.resume());
  }

  /** Both ends see the end of all connections. */
  drop(): void {
    for (const pair of [...this.pairs]) pair.forEach((socket) => socket.destroy());
  }

  async close(): Promise<void> {
    this.drop();
    await new Promise((resolve) => this.server.close(resolve));
  }

  private join(near: Socket): void {
    const far = connect(this.port, '127.0.0.1');
    const pair = [near, far] as const;
    this.pairs.add(pair);
    const end = (): void => {
      this.pairs.delete(pair);
      near.destroy();
      far.destroy();
    };
    for (const [from, to] of [[near, far], [far, near]] as const) {
      from.on('data', (part) => to.write(part));
      from.on('error', end);
      from.on('close', end);
      if (this.isCut) from.pause();
    }
  }
}
