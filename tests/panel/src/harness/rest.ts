// The panel's REST half, as a script would use it: with a cookie, and without a browser's rules about headers.
import { request, type IncomingHttpHeaders } from 'node:http';
import { until } from './waiting';

export interface RestAnswer {
  readonly status: number;
  readonly headers: IncomingHttpHeaders;
  readonly text: string;
  // eslint-disable-next-line @typescript-eslint/no-explicit-any
  readonly body: any;
}

export interface RestOptions {
  readonly method?: string;
  readonly body?: unknown;
  readonly headers?: { readonly [name: string]: string };
}

export class Rest {
  cookie = '';

  /** `base`: "http://127.0.0.1:8080". */
  constructor(readonly base: string) {}

  /** The path is below /api/v1, or absolute. */
  async ask(path: string, options: RestOptions = {}): Promise<RestAnswer> {
    const address = new URL(/^(\/|http)/.test(path) ? path : `/api/v1/${path}`, this.base);
    const body = options.body === undefined ? undefined : JSON.stringify(options.body);
    const answer = await new Promise<RestAnswer>((resolve, reject) => {
      const asked = request(
        address,
        {
          method: options.method ?? (body === undefined ? 'GET' : 'POST'),
          agent: false,
          headers: {
            ...(this.cookie && { cookie: this.cookie }),
            ...(body !== undefined && { 'content-type': 'application/json', 'content-length': String(Buffer.byteLength(body)) }),
            ...(options.method !== undefined || body !== undefined ? { origin: this.base } : {}),
            ...options.headers,
          },
        },
        (incoming) => {
          const parts: Buffer[] = [];
          incoming.on('data', (part: Buffer) => parts.push(part));
          incoming.on('error', reject);
          incoming.on('end', () => {
            const text = Buffer.concat(parts).toString('utf8');
            const isJson = /json/.test(incoming.headers['content-type'] ?? '');
            resolve({ status: incoming.statusCode ?? 0, headers: incoming.headers, text, body: isJson && text ? JSON.parse(text) : undefined });
          });
        },
      );
      asked.on('error', reject);
      asked.end(body);
    });
    const set = answer.headers['set-cookie']?.[0];
    if (set) this.cookie = set.split(';')[0] ?? '';
    return answer;
  }

  /** Throws unless it was done. */
  async do(path: string, options: RestOptions = {}): Promise<RestAnswer> {
    const answer = await this.ask(path, options);
    if (answer.status >= 400) throw new Error(`${path}: ${answer.status} ${answer.text}`);
    return answer;
  }

  async feedback<Feedback extends object>(component: string): Promise<Feedback> {
    return await this.published(component, 'feedback') as Feedback;
  }

  async runtime(component: string): Promise<{ [path: string]: unknown }> {
    return await this.published(component, 'runtime') as { [path: string]: unknown };
  }

  async configuration(component: string): Promise<{ [path: string]: unknown }> {
    return (await this.do(`components/${component}/parameters`)).body.configuration;
  }

  /** The panel is there before each unit has made its first step; until then it has published nothing. */
  private async published(component: string, kind: 'feedback' | 'runtime'): Promise<object> {
    return until(async () => ((await this.do(`components/${component}/parameters`)).body[kind] as object | null) ?? undefined,
      () => `${component} published no ${kind}`);
  }
}
