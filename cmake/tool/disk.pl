# disk.pl hold DEVICE COMMAND...: opens a disk so that nobody else may mount or claim it or a part of it, and runs the command, for which
# FLEXRF_HELD is the number of the file descriptor. The disk is held until the command and all that it started have ended.
# disk.pl scan DESCRIPTOR: has the kernel read the partitions of the disk that is held there.
# No program of a shell opens with O_EXCL what exists already. Perl is on every Debian (perl-base).
use strict;
use warnings;
use Errno qw(EBUSY);
use Fcntl qw(:DEFAULT :flock SEEK_SET);

sub refuse { print STDERR "flexrf: @_\n"; exit 1 }

sub hold {
  my ($device, @command) = @_;
  sysopen(my $disk, $device, O_RDWR | O_EXCL)
    or refuse($! == EBUSY ? "$device is in use by another program, as a flash that runs already: nothing was written to it"
                          : "$device cannot be opened for writing ($!): nothing was written to it");
  # The lock keeps udev from looking at a disk that is half written. udev holds it itself for moments.
  for (my $k = 0; !flock($disk, LOCK_EX | LOCK_NB); ++$k) {
    refuse("$device is locked by another program, as a flash that runs already: nothing was written to it") if $k == 50;
    select(undef, undef, undef, 0.1);
  }
  # A virtual machine opens its disk without O_EXCL, and locks some bytes of it. struct flock of Linux: l_type, l_whence, l_start, l_len, l_pid.
  my $others = pack('s s x![q] q q i x![q]', F_WRLCK, SEEK_SET, 0, 0, 0);
  fcntl($disk, F_GETLK, $others) or refuse("$device: whether another program has locked it cannot be told: $!");
  refuse("$device is locked by another program, as a virtual machine that runs from it: nothing was written to it")
    if unpack('s', $others) != F_UNLCK;
  fcntl($disk, F_SETFD, 0) or refuse("$device cannot be held: $!");
  $ENV{FLEXRF_HELD} = fileno($disk);
  exec {$command[0]} @command or refuse("$command[0]: $!");
}

sub scan {
  open(my $disk, '+<&=', $_[0]) or exit 1;
  exit(ioctl($disk, 0x125f, 0) ? 0 : 1); # BLKRRPART
}

my $what = shift @ARGV;
$what eq 'hold' ? hold(@ARGV) : scan(@ARGV);
