// Parts of the page that come in files of their own, when they are needed first.

/** Why one is missing; browsers have words of their own for it, which name only a file. */
const notLoaded = 'it could not be loaded. Either there is no connection, or the application was replaced by another build: then load the page again';

/** Rejects with the reason for people. May be asked again: what failed is fetched anew. */
export async function loadPart<Part>(load: () => Promise<Part>): Promise<Part> {
  try {
    return await load();
  } catch (cause) {
    throw new Error(notLoaded, { cause });
  }
}
